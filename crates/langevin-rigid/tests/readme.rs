//! The program that the READMEs show is an example, which is compiled and run.

#[test]
fn readmes_show_the_example_as_it_is() {
    let example = include_str!("../examples/drop_a_leaf.rs");
    let (_, program) = example.split_once("\n\n").unwrap();
    let shown = format!("```rust\n{program}```\n");
    for readme in [
        include_str!("../README.md"),
        include_str!("../../../README.md"),
    ] {
        assert!(readme.contains(&shown));
    }
}
