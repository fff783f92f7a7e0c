use std::time::{Duration, Instant};

use super::compressed::{BALLS, packed};
use super::*;

/// A brick with every part that is read: a skin, morph targets, instances, sparse items, integers.
fn everything() -> Vec<u8> {
    let mut maker = Maker::brick();
    let numbers = maker.view(&[0, 1], "");
    let target = maker.accessor_json(&format!(
        r#""componentType":5126,"count":8,"type":"VEC3","sparse":{{"count":2,
        "indices":{{"bufferView":{numbers},"componentType":5121}},"values":{{"bufferView":0}}}}"#
    ));
    let joints = maker.accessor(&[0; 32], UNSIGNED_BYTE, "VEC4", 8, "");
    let weights = maker.accessor(
        &[200, 0, 0, 0].repeat(8),
        UNSIGNED_BYTE,
        "VEC4",
        8,
        r#","normalized":true"#,
    );
    let places = maker.accessor(&floats(&[0.0, 1.0, 2.0]), FLOAT, "VEC3", 1, "");
    let turns = maker.accessor(&[0, 0, 0, 127], BYTE, "VEC4", 1, r#","normalized":true"#);
    maker.glb(&format!(
        r#""scene":0,"scenes":[{{"nodes":[0,1]}}],"nodes":[{{"mesh":0,"skin":0}},{{"mesh":0,"weights":[0.5],
        "rotation":[0,0,0,1],"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":
        {{"TRANSLATION":{places},"ROTATION":{turns}}}}}}}}}],"skins":[{{"joints":[1]}}],
        "meshes":[{{"weights":[0.25],"primitives":[{{"attributes":
        {{"POSITION":0,"JOINTS_0":{joints},"WEIGHTS_0":{weights}}},"indices":1,
        "targets":[{{"POSITION":{target}}}]}}]}}]"#
    ))
}

/// Whatever happens to a file, reading it ends soon, and in an answer.
#[test]
fn damaged_files_never_panic_or_take_long() {
    let mut files = vec![
        everything(),
        packed("EXT_meshopt_compression", true, false),
        packed("KHR_meshopt_compression", false, true),
    ];
    files.extend(BALLS.map(|(file, _)| file.to_vec()));
    for good in files {
        assert!(read(&good).is_ok(), "{:?}", read(&good));
        let mut slowest = Duration::ZERO;
        let mut refused = 0;
        let mut attempt = |bytes: &[u8]| {
            let begin = Instant::now();
            refused += usize::from(read(bytes).is_err());
            slowest = slowest.max(begin.elapsed());
        };
        for at in 0..good.len() {
            attempt(&good[..at]);
            for damage in [0x00, 0xff, good[at] ^ 1, good[at] ^ 0x80, b'9', b'-'] {
                let mut bytes = good.clone();
                bytes[at] = damage;
                attempt(&bytes);
            }
        }
        assert!(refused > good.len(), "{refused} refused");
        assert!(slowest < Duration::from_secs(2), "{slowest:?}");
    }
}
