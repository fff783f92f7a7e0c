//! Code in the manual that cannot be run here, held against the header.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const HERE: &str = env!("CARGO_MANIFEST_DIR");
const GODOT: &str = "../../docs/destinations/godot.md";
const UNITY: &str = "../../docs/destinations/unity.md";

fn read(path: &str) -> String {
    let text = std::fs::read_to_string(Path::new(HERE).join(path));
    text.unwrap()
}

/// The header without comments.
fn header() -> String {
    let text = read("include/langevin_rigid.h");
    let code = text
        .split("/*")
        .map(|part| part.split_once("*/").map_or(part, |(_, code)| code));
    code.collect()
}

/// Words that begin like names of the interface.
fn names(text: &str) -> BTreeSet<&str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| word.starts_with("lr_") || word.starts_with("LR_"))
        .collect()
}

#[test]
fn every_name_is_declared() {
    let header = header();
    let declared = names(&header);
    for page in [
        "README.md",
        GODOT,
        UNITY,
        "../../docs/destinations/unreal.md",
    ] {
        let text = read(page);
        let used = names(&text);
        assert!(!used.is_empty(), "{page} uses nothing");
        for name in used {
            assert!(
                declared.contains(name),
                "{page} uses {name}, which the header does not declare"
            );
        }
    }
}

/// The README names every function.
#[test]
fn every_function_is_in_the_readme() {
    let (header, readme) = (header(), read("README.md"));
    let named = names(&readme);
    let functions = functions(&header);
    assert!(functions.len() > 30);
    for name in functions.keys() {
        assert!(named.contains(name.as_str()), "the README lacks {name}");
    }
}

/// Type and name of each field or parameter: `double x, y` are two.
fn members(list: &str, between: char) -> Vec<(String, String)> {
    let mut members = Vec::new();
    for declaration in list.split(between) {
        let declaration = declaration.trim().trim_start_matches("public ");
        if declaration.is_empty() || declaration == "void" {
            continue;
        }
        let mut several = declaration.split(',').map(str::trim);
        let first = several.next().unwrap_or_default();
        let at = first.rfind([' ', '*']).unwrap() + 1;
        let (of, name) = (first[..at].trim().to_owned(), &first[at..]);
        members.push((of.clone(), name.to_owned()));
        members.extend(several.map(|name| (of.clone(), name.to_owned())));
    }
    members
}

/// What is in the braces after a name that comes after `struct`, as the language has it, by name.
fn structs(code: &str, begin: &str) -> BTreeMap<String, Vec<(String, String)>> {
    let mut found = BTreeMap::new();
    for rest in code.split(begin).skip(1) {
        let Some((name, rest)) = rest.split_once('{') else {
            continue;
        };
        let name = name.trim();
        if name.starts_with("lr_") && !name.contains([' ', ';', '*', ',']) {
            let (fields, _) = rest.split_once('}').unwrap();
            found.insert(name.to_owned(), members(fields, ';'));
        }
    }
    found
}

/// Type that comes back, and types and names of the parameters, by name.
fn functions(code: &str) -> BTreeMap<String, (String, Vec<(String, String)>)> {
    let mut found = BTreeMap::new();
    for statement in code.split([';', '{', '}']) {
        let Some((head, parameters)) = statement.split_once('(') else {
            continue;
        };
        let Some(at) = head.rfind("lr_") else {
            continue;
        };
        let parameters = parameters.split(')').next().unwrap_or_default();
        let back = head[..at].trim().lines().last().unwrap_or_default();
        found.insert(
            head[at..].to_owned(),
            (back.to_owned(), members(parameters, ',')),
        );
    }
    found
}

/// A type of C# as it may stand for one of C.
fn fits(sharp: &str, c: &str) -> bool {
    let c = c.replace("struct ", "").replace("enum ", "");
    if let Some(pointed) = c.trim_start_matches("const ").strip_suffix('*') {
        let pointed = pointed.trim();
        return match sharp.split_once(' ') {
            Some(("ref", of)) => of == pointed,
            Some(("out", "IntPtr")) => pointed.ends_with('*'),
            Some(("out", of)) => of == pointed && !c.starts_with("const"),
            Some(_) => false,
            None => sharp == "IntPtr" || (sharp == "byte[]" && pointed == "uint8_t"),
        };
    }
    let same = match sharp {
        "ulong" => "uint64_t",
        "uint" => "uint32_t",
        "int" => return c == "int32_t" || c == "lr_status",
        "UIntPtr" => "size_t",
        other => other,
    };
    same == c
}

#[test]
fn unity_has_the_structs_of_the_header() {
    let (header, page) = (
        structs(&header(), "typedef struct "),
        structs(&read(UNITY), "public struct "),
    );
    assert_eq!(page.len(), 8);
    for (name, fields) in page {
        let declared = &header[&name];
        assert_eq!(fields.len(), declared.len(), "{name}");
        for ((of, field), (of_c, field_c)) in fields.iter().zip(declared) {
            assert_eq!(field, field_c, "{name}");
            assert!(
                fits(of, of_c),
                "{name}.{field} is {of}, in the header {of_c}"
            );
        }
    }
}

#[test]
fn unity_has_the_functions_of_the_header() {
    let header = functions(&header());
    let page = read(UNITY);
    let imported: String = page
        .lines()
        .filter_map(|line| line.split_once("static extern "))
        .map(|(_, declaration)| format!("{declaration}\n"))
        .collect();
    let imported = functions(&imported);
    assert_eq!(imported.len(), page.matches("[DllImport(").count());
    for (name, (back, parameters)) in imported {
        let (back_c, parameters_c) = &header[&name];
        assert!(
            fits(&back, back_c),
            "{name} returns {back}, in the header {back_c}"
        );
        assert_eq!(parameters.len(), parameters_c.len(), "{name}");
        for ((of, parameter), (of_c, _)) in parameters.iter().zip(parameters_c) {
            assert!(
                fits(of, of_c),
                "{parameter} of {name} is {of}, in the header {of_c}"
            );
        }
    }
    let version = format!(
        "#define LR_ABI_VERSION {}",
        langevin_rigid_c::LR_ABI_VERSION
    );
    assert!(read("include/langevin_rigid.h").contains(&version));
    let checked = format!("lr_abi_version() != {}", langevin_rigid_c::LR_ABI_VERSION);
    assert!(page.contains(&checked), "the page checks another version");
}

/// Its two files, with stand-ins for godot-cpp.
#[test]
fn the_node_of_godot_is_cpp() {
    let Some(mut command) = common::compiler("CXX", "c++") else {
        return;
    };
    let page = read(GODOT);
    let files: Vec<&str> = page
        .split("```cpp\n")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .collect();
    let [declared, defined] = files[..] else {
        panic!("{GODOT} has {} files in C++", files.len());
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let write = |name: &str, text| std::fs::write(folder.join(name), text).unwrap();
    write("drifting_body.h", declared);
    write("drifting_body.cpp", defined);
    let compiled = command
        .args([
            "-std=c++17",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-fsyntax-only",
            "-I",
        ])
        .arg(Path::new(HERE).join("include"))
        .arg("-I")
        .arg(Path::new(HERE).join("tests/stand-ins"))
        .arg(folder.join("drifting_body.cpp"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{said}");
}
