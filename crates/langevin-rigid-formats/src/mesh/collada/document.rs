//! Elements of a document, by what they are and by their ids.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use super::super::proportion::{most_triangles, too_many};
use super::super::text::Numbers;
use super::super::unit::FileUnit;
use super::super::{ParseError, Place};

pub(super) type Element<'a> = roxmltree::Node<'a, 'a>;

/// A document with its elements by id.
pub(super) struct Document<'a> {
    root: Element<'a>,
    /// By tag and id, as files have one id for elements of several kinds; nothing where it is not the only one.
    ids: BTreeMap<[&'a str; 2], Option<Element<'a>>>,
    numbers: RefCell<Numbers>,
    notices: RefCell<Vec<String>>,
    /// Bytes of the file.
    size: u64,
    /// Triangles that it has been found to stand for.
    triangles: Cell<u64>,
}

impl<'a> Document<'a> {
    /// A file of `size` bytes.
    pub(super) fn new(
        tree: &'a roxmltree::Document<'a>,
        size: u64,
    ) -> Result<Document<'a>, ParseError> {
        let root = tree.root_element();
        if root.tag_name().name() != "COLLADA" {
            return Err(fault(root, "this XML is not Collada"));
        }
        let version = root.attribute("version").unwrap_or("1.4");
        if !(version.starts_with("1.4") || version.starts_with("1.5")) {
            return Err(ParseError::Unsupported {
                feature: format!("version {} of Collada", shortened(version)),
                remedy: "export it as Collada 1.4.1, glTF, OBJ or STL",
            });
        }
        let mut ids = BTreeMap::new();
        for element in root.descendants() {
            if let Some(id) = element.attribute("id") {
                ids.entry([element.tag_name().name(), id])
                    .and_modify(|twice| *twice = None)
                    .or_insert(Some(element));
            }
        }
        Ok(Document {
            root,
            ids,
            numbers: RefCell::default(),
            notices: RefCell::default(),
            size,
            triangles: Cell::default(),
        })
    }

    pub(super) fn root(&self) -> Element<'a> {
        self.root
    }

    /// The file's unit of length; metres where it states none, as the specification says.
    pub(super) fn unit(&self) -> Result<FileUnit, ParseError> {
        let unit = child(self.root, "asset").and_then(|asset| child(asset, "unit"));
        let metre = unit.and_then(|unit| Some((unit, unit.attribute("meter")?)));
        let Some((unit, metre)) = metre else {
            self.note("it states no unit of length: took it to be in metres, as Collada says");
            return Ok(FileUnit::of_metres(1.0));
        };
        let metres = self.numbers.borrow_mut().finite(metre.trim());
        let metres = metres.map_err(|reason| fault(unit, &reason))?;
        if metres > 0.0 {
            Ok(FileUnit::of_metres(metres))
        } else {
            let reason = format!("its unit of length is {metres} m, which is none");
            Err(fault(unit, &reason))
        }
    }

    /// The element of one of some kinds that an attribute refers to.
    pub(super) fn referred(
        &self,
        from: Element<'a>,
        attribute: &str,
        kinds: &[&'a str],
    ) -> Result<Element<'a>, ParseError> {
        let address = required(from, attribute)?;
        let Some(id) = address.strip_prefix('#') else {
            return Err(ParseError::Unsupported {
                feature: format!("`{}`, which is in another file", shortened(address)),
                remedy: "export everything into one file",
            });
        };
        self.of_id(from, id, kinds)
    }

    /// The element of one of some kinds that has an id.
    pub(super) fn of_id(
        &self,
        from: Element<'a>,
        id: &'a str,
        kinds: &[&'a str],
    ) -> Result<Element<'a>, ParseError> {
        let known = kinds.iter().find_map(|kind| self.ids.get(&[*kind, id]));
        let id = || shortened(id);
        match known {
            Some(Some(element)) => Ok(*element),
            Some(None) => Err(fault(
                from,
                &format!("there are several with the id `{}`", id()),
            )),
            None => {
                let reason = format!("there is no {} with the id `{}`", kinds.join(" or "), id());
                Err(fault(from, &reason))
            }
        }
    }

    /// The finite numbers in an element.
    pub(super) fn finite(&self, element: Element<'a>) -> Result<Vec<f64>, ParseError> {
        self.numbers(element, Numbers::finite)
    }

    /// The numbers in an element, some of which may be none.
    pub(super) fn any(&self, element: Element<'a>) -> Result<Vec<f64>, ParseError> {
        self.numbers(element, Numbers::any)
    }

    fn numbers(
        &self,
        element: Element<'a>,
        read: fn(&mut Numbers, &str) -> Result<f64, String>,
    ) -> Result<Vec<f64>, ParseError> {
        let mut numbers = self.numbers.borrow_mut();
        words(element)
            .map(|word| read(&mut numbers, word).map_err(|reason| fault(element, &reason)))
            .collect()
    }

    /// Counts triangles before they are made, and refuses more than the size of the file accounts for.
    pub(super) fn charge(&self, triangles: usize) -> Result<(), ParseError> {
        let sum = self.triangles.get().saturating_add(triangles as u64);
        self.triangles.set(sum);
        let most = most_triangles(self.size);
        if sum > most {
            Err(too_many(most, self.size))
        } else {
            Ok(())
        }
    }

    /// Counts reading an element that others may have read before as the triangles that its length may hold.
    pub(super) fn charge_reading(&self, element: Element<'a>) -> Result<(), ParseError> {
        self.charge(1 + element.range().len() / 16)
    }

    /// Says something once.
    pub(super) fn note(&self, notice: &str) {
        let mut notices = self.notices.borrow_mut();
        if !notices.iter().any(|known| known == notice) {
            notices.push(notice.to_owned());
        }
    }

    pub(super) fn notices(self) -> impl Iterator<Item = String> {
        let numbers = self.numbers.into_inner().notice();
        self.notices.into_inner().into_iter().chain(numbers)
    }
}

/// The first element of a kind in another.
pub(super) fn child<'a>(of: Element<'a>, kind: &'a str) -> Option<Element<'a>> {
    children(of, kind).next()
}

/// The elements of a kind in another.
pub(super) fn children<'a>(
    of: Element<'a>,
    kind: &'a str,
) -> impl Iterator<Item = Element<'a>> + use<'a> {
    elements(of).filter(move |element| element.tag_name().name() == kind)
}

/// All elements in another.
pub(super) fn elements<'a>(of: Element<'a>) -> impl Iterator<Item = Element<'a>> + use<'a> {
    of.children().filter(|node| node.is_element())
}

/// An element of a kind that must be in another.
pub(super) fn part<'a>(of: Element<'a>, kind: &'a str) -> Result<Element<'a>, ParseError> {
    child(of, kind).ok_or_else(|| fault(of, &format!("it has no `{kind}`")))
}

/// An attribute that must be there.
pub(super) fn required<'a>(element: Element<'a>, name: &str) -> Result<&'a str, ParseError> {
    let missing = || fault(element, &format!("it has no attribute `{name}`"));
    element.attribute(name).ok_or_else(missing)
}

/// An attribute that is a whole number, if it is there.
pub(super) fn whole(element: Element<'_>, name: &str) -> Result<Option<usize>, ParseError> {
    let number = |word: &str| {
        let bad = |_| {
            let reason = format!("its {name} `{}` is not a whole number", shortened(word));
            fault(element, &reason)
        };
        word.trim().parse().map_err(bad)
    };
    element.attribute(name).map(number).transpose()
}

/// The words in an element, comments left out.
pub(super) fn words<'a>(element: Element<'a>) -> impl Iterator<Item = &'a str> {
    let texts = element.children().filter(|node| node.is_text());
    texts.flat_map(|node| node.text().unwrap_or_default().split_ascii_whitespace())
}

/// The whole numbers in an element.
pub(super) fn integers<T: std::str::FromStr>(element: Element<'_>) -> Result<Vec<T>, ParseError> {
    words(element).map(|word| integer(element, word)).collect()
}

pub(super) fn integer<T: std::str::FromStr>(
    element: Element<'_>,
    word: &str,
) -> Result<T, ParseError> {
    let bad = |_| {
        let reason = format!(
            "`{}` is not a number of a vertex or a count",
            shortened(word)
        );
        fault(element, &reason)
    };
    word.parse().map_err(bad)
}

/// What is wrong with an element.
pub(super) fn fault(element: Element<'_>, reason: &str) -> ParseError {
    let at = element.document().text_pos_at(element.range().start);
    let kind = element.tag_name().name();
    ParseError::at(
        Place::Line(at.row as usize),
        format!("in `{kind}`: {reason}"),
    )
}

pub(super) fn shortened(word: &str) -> String {
    word.chars().take(40).collect()
}
