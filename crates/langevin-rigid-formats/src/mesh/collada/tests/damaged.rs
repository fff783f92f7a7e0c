use std::time::{Duration, Instant};

use super::*;

/// Whatever happens to a file, reading it ends soon, and in an answer.
#[test]
fn damaged_files_never_panic_or_take_long() {
    let good = scene(&format!(
        "<node><rotate>0 0 1 9</rotate><scale>1 2 3</scale><node id=\"n\">{SHOWN}</node>\
         <instance_node url=\"#n\"/></node>"
    ));
    assert!(read(&good).is_ok());
    let mut slowest = Duration::ZERO;
    let mut refused = 0;
    let mut attempt = |bytes: &[u8]| {
        let begin = Instant::now();
        refused += usize::from(parse_mesh(bytes, MeshFormat::Collada, None, None).is_err());
        slowest = slowest.max(begin.elapsed());
    };
    let good = good.as_bytes();
    for at in 0..good.len() {
        attempt(&good[..at]);
        for damage in [
            0x00,
            0xff,
            good[at] ^ 1,
            good[at] ^ 0x80,
            b'9',
            b'-',
            b'<',
            b'"',
            b' ',
        ] {
            let mut bytes = good.to_vec();
            bytes[at] = damage;
            attempt(&bytes);
        }
    }
    assert!(refused > good.len(), "{refused} refused");
    assert!(slowest < Duration::from_secs(2), "{slowest:?}");
}
