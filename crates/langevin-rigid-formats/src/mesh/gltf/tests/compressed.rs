use super::*;

/// A ball as glTF-Transform compresses it, and its volume when the reference decoders of Draco and
/// meshoptimizer unpack it (by trimesh).
pub(super) const BALLS: [(&[u8], f64); 3] = [
    (
        include_bytes!("../../../../tests/data/ball-draco-edgebreaker.glb"),
        0.5058963736234497,
    ),
    (
        include_bytes!("../../../../tests/data/ball-draco-sequential.glb"),
        0.5058963736234497,
    ),
    (
        include_bytes!("../../../../tests/data/ball-meshopt.glb"),
        0.5059077087445978,
    ),
];

#[test]
fn compressed_files_are_what_other_decoders_make_of_them() {
    for (glb, volume) in BALLS {
        let ball = body(glb);
        assert_eq!(ball.triangles().len(), 320);
        assert!(
            (ball.volume() / volume - 1.0).abs() < 1e-6,
            "{}",
            ball.volume()
        );
        let [low, high] = ball.bounding_box();
        assert!((0..3).all(|k| (low[k] + 0.5).abs() < 1e-6 && (high[k] - 0.5).abs() < 1e-6));
    }
}

/// A brick whose views are packed as `extension`.
pub(super) fn packed(extension: &str, filtered: bool, sequence: bool) -> Vec<u8> {
    let (brick, mut maker) = (brick(), Maker::default());
    let positions: Vec<[f32; 3]> = brick
        .vertices()
        .iter()
        .map(|v| v.map(|x| x as f32))
        .collect();
    let (bytes, filter) = match filtered {
        true => {
            let mode = ::meshopt::EncodeExpMode::Separate;
            let words = ::meshopt::encode_filter_exp(&positions, 24, mode);
            (::meshopt::encode_vertex_buffer(&words), "EXPONENTIAL")
        }
        false => (::meshopt::encode_vertex_buffer(&positions), "NONE"),
    };
    let corners = brick.triangles().as_flattened();
    let (indices, mode) = match sequence {
        true => (::meshopt::encode_index_sequence(corners, 8), "INDICES"),
        false => (::meshopt::encode_index_buffer(corners, 8), "TRIANGLES"),
    };
    for (bytes, [stride, count], [mode, filter], component, shape) in [
        (
            bytes.unwrap(),
            [12, 8],
            ["ATTRIBUTES", filter],
            5126,
            "VEC3",
        ),
        (indices.unwrap(), [4, 36], [mode, "NONE"], 5125, "SCALAR"),
    ] {
        let packed = maker.view(&bytes, "");
        let offset = maker.data.len() - bytes.len().next_multiple_of(4);
        let view = maker.view_json(&format!(
            r#""buffer":1,"byteLength":{},"extensions":{{"{extension}":{{"buffer":0,"byteOffset":{offset},
            "byteLength":{},"byteStride":{stride},"count":{count},"mode":"{mode}","filter":"{filter}"}}}}"#,
            stride * count,
            bytes.len(),
        ));
        assert_eq!(view, packed + 1);
        maker.accessor_json(&format!(
            r#""bufferView":{view},"componentType":{component},"count":{count},"type":"{shape}""#
        ));
    }
    maker.shown("", "", "")
}

#[test]
fn meshoptimizer_is_unpacked_in_all_its_modes() {
    let expected = brick();
    for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        for (filtered, sequence) in [(false, false), (true, false), (false, true)] {
            let read = body(&packed(extension, filtered, sequence));
            assert_eq!(read.vertices(), expected.vertices());
            // Triangles may begin at another corner.
            assert!((read.volume() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn every_stride_of_meshoptimizer_is_unpacked() {
    let numbers: Vec<u32> = (0..64).collect();
    // The encoder's items are of one size here: what another size makes of them must not be taken.
    let bytes = ::meshopt::encode_vertex_buffer(&numbers).unwrap();
    let unpacked = |stride: usize, count: usize| {
        let json = format!(
            r#"{{"buffer":0,"byteLength":0,"byteStride":{stride},"count":{count},"mode":"ATTRIBUTES"}}"#
        );
        let packed = serde_json::from_str(&json).unwrap();
        super::super::meshopt::decompress(&bytes, &packed)
    };
    let expected: Vec<u8> = numbers.iter().flat_map(|n| n.to_ne_bytes()).collect();
    assert_eq!(unpacked(4, 64), Ok(expected));
    for stride in [0, 1, 3, 5, 8, 12, 128, 252, 256, 260, usize::MAX] {
        assert!(unpacked(stride, 64).is_err(), "{stride}");
    }
}

#[test]
fn faults_of_compressed_data_are_named() {
    let good = packed("EXT_meshopt_compression", false, false);
    for (from, to, expected) in [
        (
            r#""mode":"TRIANGLES""#,
            r#""mode":"POLYGONS""#,
            "cannot be POLYGONS",
        ),
        (
            r#""filter":"NONE""#,
            r#""filter":"OCTAHEDRAL""#,
            "filter OCTAHEDRAL",
        ),
        (
            r#""byteStride":12"#,
            r#""byteStride":16"#,
            "data of a buffer view are broken",
        ),
        (
            r#""count":36,"mode""#,
            r#""count":35,"mode""#,
            "35 compressed items",
        ),
        (
            r#""count":8,"mode""#,
            r#""count":1844674407370955161,"mode""#,
            "out of proportion",
        ),
        (
            r#""count":8,"mode""#,
            r#""count":80000000,"mode""#,
            "out of proportion",
        ),
    ] {
        let error = fault(&edited(&good, from, to));
        assert!(error.contains(expected), "{expected}: {error}");
    }
    let draco = BALLS[0].0;
    for (from, to, expected) in [
        (
            r#""count":162"#,
            r#""count":161"#,
            "not that of the accessors",
        ),
        (
            r#""count":960"#,
            r#""count":957"#,
            "faces, over the caller's ceiling",
        ),
        (
            r#""count":960"#,
            r#""count":963"#,
            "not that of the accessors",
        ),
        (r#""count":960"#, r#""count":960000000000"#, "more than"),
        (
            r#""attributes":{"POSITION":0}}"#,
            r#""attributes":{"POSITION":5}}"#,
            "no attribute 5",
        ),
        (
            r#""componentType":5126"#,
            r#""componentType":5125"#,
            "accessor 1 is VEC3",
        ),
    ] {
        let error = fault(&edited(draco, from, to));
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

/// A GLB file with a piece of its JSON replaced.
fn edited(file: &[u8], from: &str, to: &str) -> Vec<u8> {
    let length = u32::from_le_bytes(*file[12..].first_chunk().unwrap()) as usize;
    let json = std::str::from_utf8(&file[20..20 + length]).unwrap();
    assert!(json.contains(from), "{from}");
    glb(&json.replacen(from, to, 1), &file[28 + length..])
}
