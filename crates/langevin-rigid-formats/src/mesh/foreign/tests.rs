use super::*;

#[test]
fn foreign_files_are_known_by_their_content() {
    let mut iges = vec![b' '; 80];
    iges[72..].copy_from_slice(b"S      1");
    let mut studio = b"MM\x10\0\0\0".to_vec();
    studio.resize(16, 7);
    for (bytes, expected) in [
        (&b""[..], EMPTY),
        (&[0; 100], EMPTY),
        (
            b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 684\n",
            POINTER,
        ),
        (b"BLENDER-v300REND", BLENDER),
        (b"Kaydara FBX Binary  \0\x1a\0", FBX),
        (b"; FBX 7.7.0 project file\n", FBX),
        (b"ISO-10303-21;\nHEADER;", STEP),
        (&iges, IGES),
        (&studio, STUDIO),
        (b"PK\x03\x04\x14\0\0\0\x08\x003D/3dmodel.model", THREE_MF),
        (b"PK\x03\x04\x0a\0\0\0\0\0body.usdc\0\0", USD),
        (b"PK\x03\x04\x0a\0\0\0\0\0body.obj", ZIP),
        (b"#usda 1.0\n", USD),
        (b"PXR-USDC\0", USD),
        (b"#VRML V2.0 utf8\n", VRML),
        (b"<?xml version=\"1.0\"?>\n<X3D version='3.0'>", VRML),
        (b"PK\x03\x04\x0a\0\0\0\0\0body.dae", ZAE),
        (b"\n<!DOCTYPE html><html>", HTML),
        (b"OFF\n8 6 12\n", OFF),
        (b"# hull\nCOFF 8 6 12\n", OFF),
        (b"\x89PNG\r\n\x1a\n", IMAGE),
        (b"\xff\xd8\xff\xe0", IMAGE),
        (b"\x1f\x8b\x08\0", GZIP),
    ] {
        assert_eq!(Foreign::of_content(bytes), Some(expected));
    }
    for mesh in [
        &b"v 0 0 0\n"[..],
        b"# usda\nv 0 0 0\n",
        b"solid off\n",
        b"ply\n",
        b"{\"asset\":{}}",
        b"glTF\x02\0\0\0",
        b"\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- <html> --><COLLADA>",
        b"MM",
        b"<svg/>",
    ] {
        assert_eq!(Foreign::of_content(mesh), None);
    }
}

#[test]
fn the_extension_decides_where_the_content_does_not() {
    assert_eq!(Foreign::of_extension("hull.STP".as_ref()), Some(STEP));
    assert_eq!(Foreign::of_extension("hull.3ds".as_ref()), Some(STUDIO));
    assert_eq!(Foreign::of_extension("hull.obj".as_ref()), None);
    assert_eq!(Foreign::of_extension("hull".as_ref()), None);
}
