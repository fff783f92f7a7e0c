//! Every case has the bits that are pinned, in the profile of tests. Where they change, trajectories of users change: say so
//! in the changelog, and write the last line of `cargo run --release --bin sameness` into `pinned`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[test]
fn every_case_has_the_pinned_bits() {
    let lines = sameness::lines().unwrap();
    let all = format!("{:016x}", lines.last().unwrap().hash);
    assert_eq!(all, include_str!("../pinned").trim());
}
