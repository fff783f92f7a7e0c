//! Choices by name, and what to say of a name that none has.

use std::fmt;

/// The choice of that name.
///
/// ```
/// use langevin_rigid::choose;
///
/// let colours = [("red", [255, 0, 0]), ("green", [0, 255, 0])];
/// assert_eq!(choose("colour", "red", colours), Ok([255, 0, 0]));
/// assert_eq!(
///     choose("colour", "gren", colours).unwrap_err().to_string(),
///     "`gren` is no colour; did you mean `green`? Choose one of red, green"
/// );
/// ```
///
/// # Errors
/// [`UnknownName`] if there is none.
pub fn choose<T>(
    what: &'static str,
    name: &str,
    choices: impl IntoIterator<Item = (&'static str, T)>,
) -> Result<T, UnknownName> {
    let mut known = Vec::new();
    for (choice, value) in choices {
        if choice == name {
            return Ok(value);
        }
        known.push(choice);
    }
    Err(UnknownName {
        what,
        name: name.to_owned(),
        known,
    })
}

/// A name that no choice has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    /// What was being named.
    pub what: &'static str,
    /// The name as given.
    pub name: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

impl UnknownName {
    /// The known name that may have been meant: at most a third of it is written otherwise.
    pub fn nearest(&self) -> Option<&'static str> {
        let name: Vec<char> = self.name.to_lowercase().chars().collect();
        let near = self.known.iter().filter_map(|known| {
            let letters: Vec<char> = known.chars().collect();
            let most = letters.len() / 3;
            // Before the distance, whose cost is the product of the lengths.
            let distance = (letters.len().abs_diff(name.len()) <= most)
                .then(|| edits(&name, &letters))
                .filter(|distance| *distance <= most)?;
            Some((distance, *known))
        });
        near.min_by_key(|(distance, _)| *distance)
            .map(|(_, known)| known)
    }
}

impl std::error::Error for UnknownName {}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, name, known } = self;
        write!(f, "`{name}` is no {what}; ")?;
        match self.nearest() {
            Some(meant) => write!(f, "did you mean `{meant}`? Choose")?,
            None => f.write_str("choose")?,
        }
        write!(f, " one of {}", known.join(", "))
    }
}

/// How many letters to insert, drop, replace or swap with their neighbour (optimal string alignment).
fn edits(a: &[char], b: &[char]) -> usize {
    let mut table = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let replaced = table[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let least = replaced.min(table[i - 1][j].min(table[i][j - 1]) + 1);
                let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
                if swapped {
                    least.min(table[i - 2][j - 2] + 1)
                } else {
                    least
                }
            };
        }
    }
    table[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(name: &str) -> Option<&'static str> {
        let known = ["y", "rk4", "leaf", "paper-75", "paper-30", "kirchhoff"];
        let choices = known.map(|name| (name, ()));
        choose("thing", name, choices).unwrap_err().nearest()
    }

    #[test]
    fn a_slip_of_the_pen_is_recognized_and_another_word_is_not() {
        for (slip, meant) in [
            ("rk5", "rk4"),
            ("lefa", "leaf"),
            ("Leaf", "leaf"),
            ("paper-76", "paper-75"),
            ("kirchoff", "kirchhoff"),
        ] {
            assert_eq!(nearest(slip), Some(meant));
        }
        let long = "leaf".repeat(100_000);
        for other in ["", "x", "tree", "euler", &long] {
            assert_eq!(nearest(other), None, "{other:.9}");
        }
    }
}
