//! Files that are no meshes, or meshes of formats that are not read, told apart to say what helps.

use std::path::Path;

/// A kind of file that is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Foreign {
    /// What it is, as in "the file is ...".
    pub(super) what: &'static str,
    /// How to come by a mesh that is read.
    pub(super) remedy: &'static str,
}

const EXPORT: &str = "open it in a program such as Blender and export glTF (.glb), OBJ or STL";
const CAD: &str = "open it in a CAD program such as FreeCAD, mesh it and export STL";
const BLENDER: Foreign = kind(
    "a Blender scene",
    "export it from Blender as glTF (.glb), OBJ or STL",
);
const FBX: Foreign = kind("an FBX scene", EXPORT);
const ZAE: Foreign = kind(
    "a zipped Collada scene",
    "unpack it and name the .dae file in it",
);
const STUDIO: Foreign = kind("a 3D Studio scene", EXPORT);
const STEP: Foreign = kind("a STEP file of exact surfaces", CAD);
const IGES: Foreign = kind("an IGES file of exact surfaces", CAD);
const THREE_MF: Foreign = kind("a 3MF package", "export STL from the slicer or CAD program");
const OFF: Foreign = kind(
    "an OFF mesh",
    "convert it to PLY or OBJ, for instance in MeshLab",
);
const USD: Foreign = kind("a USD scene", EXPORT);
const VRML: Foreign = kind("a VRML or X3D scene", EXPORT);
const ZIP: Foreign = kind("a zip archive", "unpack it and name the mesh file in it");
const GZIP: Foreign = kind("compressed", "unpack it first");
const IMAGE: Foreign = kind("a picture", "name the mesh file itself");
const HTML: Foreign = kind(
    "a web page",
    "the download gave a page in place of the file; fetch the file itself (its raw form)",
);
const POINTER: Foreign = kind(
    "a Git LFS pointer, not the mesh itself",
    "fetch the real file with `git lfs pull`",
);
const EMPTY: Foreign = kind("empty", "export it again");

/// What files begin with, in the letters they have.
const BEGINNINGS: &[(&[u8], Foreign)] = &[
    (b"version https://git-lfs.github.com", POINTER),
    (b"BLENDER", BLENDER),
    (b"Kaydara FBX Binary", FBX),
    (b"; FBX", FBX),
    (b"ISO-10303-21", STEP),
    (b"PXR-USDC", USD),
    (b"#usda", USD),
    (b"#VRML", VRML),
    (b"#X3D", VRML),
    (b"\x89PNG", IMAGE),
    (b"\xff\xd8\xff", IMAGE),
    (b"GIF8", IMAGE),
    (b"\x1f\x8b", GZIP),
    (b"\x28\xb5\x2f\xfd", GZIP),
    (b"BZh", GZIP),
    (b"\xfd7zXZ\0", GZIP),
    (b"7z\xbc\xaf\x27\x1c", ZIP),
];

/// First words of text files.
const WORDS: [&str; 5] = ["off", "coff", "noff", "cnoff", "stoff"];

/// The root elements of markup.
const ROOTS: [(&str, Foreign); 3] = [("<x3d", VRML), ("<!doctype html", HTML), ("<html", HTML)];

/// How much of a file is looked at for a root element, which comments may precede.
const PROLOGUE: usize = 4096;

const fn kind(what: &'static str, remedy: &'static str) -> Foreign {
    Foreign { what, remedy }
}

impl Foreign {
    /// What some bytes are by what only that kind of file has.
    pub(super) fn of_content(bytes: &[u8]) -> Option<Foreign> {
        if bytes.iter().all(|&b| b == 0) {
            return Some(EMPTY);
        }
        let text = super::text::without_mark(bytes).trim_ascii_start();
        let begins = |(beginning, _): &&(&[u8], Foreign)| text.starts_with(beginning);
        let known = BEGINNINGS.iter().find(begins).map(|(_, kind)| *kind);
        known
            .or_else(|| archive(bytes))
            .or_else(|| studio(bytes))
            .or_else(|| iges(bytes))
            .or_else(|| of_text(text))
    }

    /// What a file's extension says it is.
    pub(super) fn of_extension(path: &Path) -> Option<Foreign> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "blend" => Some(BLENDER),
            "fbx" => Some(FBX),
            "zae" => Some(ZAE),
            "3ds" => Some(STUDIO),
            "step" | "stp" => Some(STEP),
            "iges" | "igs" => Some(IGES),
            "3mf" => Some(THREE_MF),
            "off" => Some(OFF),
            "usd" | "usda" | "usdc" | "usdz" => Some(USD),
            "wrl" | "vrml" | "x3d" => Some(VRML),
            "zip" | "7z" | "rar" | "tar" => Some(ZIP),
            "gz" | "bz2" | "xz" | "zst" => Some(GZIP),
            "png" | "jpg" | "jpeg" | "gif" | "webp" | "tga" | "bmp" => Some(IMAGE),
            "html" | "htm" => Some(HTML),
            _ => None,
        }
    }
}

/// Zip archives, by the names of the files in them.
fn archive(bytes: &[u8]) -> Option<Foreign> {
    let names = bytes.strip_prefix(b"PK\x03\x04")?;
    let has = |name: &[u8]| names.windows(name.len()).any(|w| w == name);
    Some(if has(b"3D/3dmodel.model") {
        THREE_MF
    } else if has(b".usdc") || has(b".usda") {
        USD
    } else if has(b".dae") {
        ZAE
    } else {
        ZIP
    })
}

/// The main chunk of a .3ds file, whose length is the file's.
fn studio(bytes: &[u8]) -> Option<Foreign> {
    let (length, _) = bytes.strip_prefix(b"MM")?.split_first_chunk::<4>()?;
    (u32::from_le_bytes(*length) as usize == bytes.len()).then_some(STUDIO)
}

/// The first record of an IGES file: `S` and its number in columns 73 to 80.
fn iges(bytes: &[u8]) -> Option<Foreign> {
    let number = bytes.get(72..80)?.strip_prefix(b"S")?;
    (number.trim_ascii() == b"1" || number == b"0000001").then_some(IGES)
}

fn of_text(text: &[u8]) -> Option<Foreign> {
    let start = String::from_utf8_lossy(&text[..text.len().min(PROLOGUE)]).to_ascii_lowercase();
    if start.starts_with('<') {
        if is_collada(text) {
            return None;
        }
        let root = ROOTS.iter().find(|(root, _)| start.contains(root));
        return root.map(|(_, kind)| *kind);
    }
    let first = super::text::words(&start).next()?.1;
    WORDS.contains(&first).then_some(OFF)
}

/// Whether the text begins as a Collada file does.
pub(super) fn is_collada(text: &[u8]) -> bool {
    let start = &text[..text.len().min(PROLOGUE)];
    let has = |root: &[u8]| start.windows(root.len()).any(|w| w == root);
    start.trim_ascii_start().starts_with(b"<") && (has(b"<COLLADA") || has(b":COLLADA"))
}

#[cfg(test)]
mod tests;
