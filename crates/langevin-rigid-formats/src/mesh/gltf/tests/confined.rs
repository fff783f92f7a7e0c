use std::path::Path;

use super::super::super::read_mesh;
use super::*;

/// A folder with a file `inside/brick.gltf` whose buffer has this address.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Place {
        let place = Place(tempfile::tempdir().unwrap());
        std::fs::create_dir(place.path("inside")).unwrap();
        let data = Maker::brick().data;
        for name in ["outside.bin", "inside/brick.bin", "inside/a b.bin"] {
            std::fs::write(place.path(name), &data).unwrap();
        }
        place
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn read(&self, uri: &str) -> Result<RawMesh, String> {
        let uri = format!(r#""uri":"{uri}","#);
        let rest = r#""nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#;
        let path = self.path("inside/brick.gltf");
        std::fs::write(&path, Maker::brick().json(&uri, rest)).unwrap();
        read_mesh(&path, None).map_err(|error| error.to_string())
    }
}

#[test]
fn buffers_are_read_from_the_folder_of_the_file_only() {
    let place = Place::new();
    std::fs::create_dir(place.path("inside/deep")).unwrap();
    std::fs::rename(
        place.path("inside/a b.bin"),
        place.path("inside/deep/a b.bin"),
    )
    .unwrap();
    for uri in ["brick.bin", "./brick.bin", "deep/a%20b.bin"] {
        assert!(place.read(uri).unwrap().body().is_ok(), "{uri}");
    }
    let absolute = place.path("inside/brick.bin");
    for uri in [
        "../outside.bin",
        "deep/../../outside.bin",
        "%2e%2e/outside.bin",
        "..%2Foutside.bin",
        "..%5Coutside.bin",
        "../inside/brick.bin",
        absolute.to_str().unwrap(),
        "../../../../../../dev/zero",
        "file:///dev/zero",
        "C:%5Cbrick.bin",
    ] {
        let error = place.read(uri).unwrap_err();
        assert!(
            error.contains("only names of files in its folder"),
            "{uri}: {error}"
        );
    }
    assert!(
        place
            .read("deep")
            .unwrap_err()
            .contains("not a regular file")
    );
    std::fs::write(place.path("inside/short.bin"), [0; 167]).unwrap();
    let error = place.read("short.bin").unwrap_err();
    assert!(error.contains("167 bytes instead of 168"), "{error}");
}

#[test]
fn a_file_longer_than_its_buffer_is_read_as_far_as_the_buffer_goes() {
    let place = Place::new();
    let data = Maker::brick().data;
    // Sparse: a terabyte that takes no room, if it is not read.
    let long = std::fs::File::create(place.path("inside/long.bin")).unwrap();
    std::io::Write::write_all(&mut &long, &data).unwrap();
    if long.set_len(1 << 40).is_ok() {
        assert!(place.read("long.bin").unwrap().body().is_ok());
    }
}

#[cfg(unix)]
#[test]
fn links_devices_and_pipes_do_not_lead_out() {
    use std::os::unix::fs::symlink;

    let place = Place::new();
    let link = |to: &Path, name: &str| symlink(to, place.path(name)).unwrap();
    link(Path::new("brick.bin"), "inside/near.bin");
    link(Path::new("../outside.bin"), "inside/far.bin");
    link(Path::new(".."), "inside/up");
    link(Path::new("/dev/zero"), "inside/zero.bin");
    assert!(place.read("near.bin").unwrap().body().is_ok());
    for uri in ["far.bin", "up/outside.bin", "zero.bin"] {
        let error = place.read(uri).unwrap_err();
        assert!(error.contains("a link out of the folder"), "{uri}: {error}");
    }
    // Opening a pipe would wait for a writer for ever.
    let made = std::process::Command::new("mkfifo")
        .arg(place.path("inside/pipe.bin"))
        .status();
    if made.is_ok_and(|status| status.success()) {
        assert!(
            place
                .read("pipe.bin")
                .unwrap_err()
                .contains("not a regular file")
        );
    }
}
