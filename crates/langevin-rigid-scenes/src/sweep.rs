//! Ensembles of many scenes as one table, in parts that any process can do.
//!
//! A sweep has points, each a scene, and so many runs of each. All its runs are numbered one after the other, those of a
//! point together, and divided into parts of so many. A part is a pure function of the points that it touches: whoever
//! does it, wherever and beside whatever, its rows have the same bits.

use std::mem::discriminant;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::table::{Column, Table, Values};

use crate::baking::{Baked, needs_history};
use crate::ensemble::{self, Fall, landings};
use crate::prepared::{PrepareError, Prepared};
use crate::scene::Scene;

/// Some of the runs of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Number of the point.
    pub point: u32,
    /// What it is.
    pub scene: Scene,
    /// The parameters that make it, for the table: name and value. All points have the same names in the same order, and
    /// under each a value of one kind.
    pub parameters: Vec<(String, Parameter)>,
    /// The runs.
    pub runs: Range<u32>,
}

/// A parameter of a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Parameter {
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
    /// Numbers, as many as there are.
    List(Vec<f64>),
}

impl Parameter {
    /// So many times, as the values of a column.
    fn repeated(&self, rows: usize) -> Values {
        match self {
            Self::Number(x) => Values::Numbers(vec![*x; rows]),
            Self::Word(word) => Values::Words(vec![word.clone().into(); rows]),
            Self::List(numbers) => Values::Lists(vec![numbers.clone(); rows]),
        }
    }
}

/// Why a part cannot be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A scene cannot be made ready.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// Points have other parameters than the first, or values of other kinds.
    #[error(
        "the parameters of point {0} do not fit into a table with those of the first: each point needs the same names, and \
         under each a number, a word or a list throughout"
    )]
    Parameters(u32),
}

/// The rows of a part: of each run `point`, its parameters and `seed`, then the columns of
/// [`landings`](ensemble::landings()). Bakes are taken from the folder `cache` and kept there.
///
/// Nothing is given of work that `progress` cancels.
///
/// ```
/// use langevin_rigid_scenes::scene::Scene;
/// use langevin_rigid_scenes::sweep::{Parameter, Piece, part};
/// let piece = |point: u32, height: f64| -> Result<Piece, Box<dyn std::error::Error>> {
///     let text = format!(r#"
///         fluid.preset = "water"
///         release.position = [0.0, {height}, 0.0]
///         run = {{ time_step = 0.002, ground = 0.0, model = "kirchhoff" }}
///         body = {{ shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 7800.0 }}
///     "#);
///     Ok(Piece {
///         point,
///         scene: Scene::parse("ball", "ball.toml", &text)?,
///         parameters: vec![("drop_height".into(), Parameter::Number(height))],
///         runs: 0..2,
///     })
/// };
/// let table = part(&[piece(0, 0.5)?, piece(1, 2.0)?], None, &())?.ok_or("cancelled")?;
/// assert_eq!(table.rows(), 4);
/// assert!(table.csv().starts_with("point,drop_height,seed,run,"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`SweepError::Parameters`] before the work; [`SweepError::Prepare`] of the first scene that cannot be made ready.
pub fn part(
    pieces: &[Piece],
    cache: Option<&Path>,
    progress: &dyn Progress,
) -> Result<Option<Table>, SweepError> {
    let unfit = |piece: &&Piece| !fit(&pieces[0].parameters, &piece.parameters);
    if let Some(piece) = pieces.iter().find(unfit) {
        return Err(SweepError::Parameters(piece.point));
    }
    let mut table = Table::default();
    let mut last: Option<(Scene, Arc<Baked>)> = None;
    for piece in pieces {
        let prepared = match &last {
            Some((scene, baked)) if of_one_bake(scene, &piece.scene) => {
                Prepared::of(piece.scene.clone(), Arc::clone(baked))?
            }
            _ => Prepared::new(piece.scene.clone(), cache, progress)?,
        };
        last = Some((piece.scene.clone(), Arc::clone(prepared.baked())));
        let falls = ensemble::run(&prepared, piece.runs.clone(), progress);
        if falls.len() < piece.runs.len() {
            return Ok(None);
        }
        table.append(rows(piece, &prepared, &falls));
    }
    Ok(Some(table))
}

/// Whether these parameters are of the same columns.
fn fit(a: &[(String, Parameter)], b: &[(String, Parameter)]) -> bool {
    let same = |((a, x), (b, y)): (&(String, Parameter), &(String, Parameter))| {
        a == b && discriminant(x) == discriminant(y)
    };
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// Whether a bake of the one is a bake of the other.
fn of_one_bake(a: &Scene, b: &Scene) -> bool {
    // A history depends on the release and the fluid as well.
    a.body == b.body && !needs_history(a) && !needs_history(b)
}

fn rows(piece: &Piece, prepared: &Prepared, falls: &[Fall]) -> Table {
    let rows = falls.len();
    let column = |name: &str, values| Column {
        name: name.to_owned().into(),
        values,
    };
    let mut columns = vec![column("point", Values::Counts(vec![piece.point; rows]))];
    let parameters = piece.parameters.iter();
    columns.extend(parameters.map(|(name, value)| column(name, value.repeated(rows))));
    columns.push(column("seed", Values::Large(vec![piece.scene.seed; rows])));
    columns.extend(landings(prepared, falls).into_columns());
    Table::new(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(point: u32, size: f64, runs: Range<u32>) -> Piece {
        let text = format!(
            "fluid.preset = \"water\"\nscatter = {{ velocity = 0.1, size = [{size}] }}\n\
             run = {{ time_step = 0.002, duration = 0.1, seed = {point} }}\n\
             body = {{ shape = \"ellipsoid\", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }}"
        );
        Piece {
            point,
            scene: Scene::parse("ball", "ball.toml", &text).unwrap(),
            parameters: vec![("times".into(), Parameter::Number(size))],
            runs,
        }
    }

    #[test]
    fn a_sweep_is_the_same_however_it_is_divided() {
        let part = |pieces: &[Piece]| part(pieces, None, &()).unwrap().unwrap();
        let whole = part(&[piece(0, 1.0, 0..6), piece(1, 2.0, 0..6)]);
        let mut divided = part(&[piece(0, 1.0, 0..4)]);
        divided.append(part(&[piece(0, 1.0, 4..6), piece(1, 2.0, 0..1)]));
        divided.append(part(&[piece(1, 2.0, 1..6)]));
        assert_eq!(divided, whole);
        assert_eq!(whole.rows(), 12);
    }

    #[test]
    fn parameters_that_are_no_columns_are_refused() {
        let with = |point, name: &str, value| Piece {
            parameters: vec![(name.into(), value)],
            ..piece(point, 1.0, 0..1)
        };
        let list = |numbers: &[f64]| Parameter::List(numbers.to_vec());
        let first = with(0, "a", list(&[0.5]));
        for other in [
            with(7, "b", list(&[0.5])),
            with(7, "a", Parameter::Number(0.5)),
            Piece {
                parameters: Vec::new(),
                ..piece(7, 1.0, 0..1)
            },
        ] {
            let refused = super::part(&[first.clone(), other], None, &()).unwrap_err();
            assert!(matches!(refused, SweepError::Parameters(7)), "{refused}");
        }
        let lists = [first, with(1, "a", list(&[0.5, 2.0]))];
        let table = super::part(&lists, None, &()).unwrap().unwrap();
        let column = &table.columns()[1];
        assert_eq!(column.name, "a");
        assert_eq!(
            column.values,
            Values::Lists(vec![vec![0.5], vec![0.5, 2.0]])
        );
    }

    #[test]
    fn nothing_is_given_of_cancelled_work() {
        struct Never;
        impl Progress for Never {
            fn report(&self, _: &str, _: f64) {}
            fn cancelled(&self) -> bool {
                true
            }
        }
        let pieces = [piece(0, 1.0, 0..6)];
        let ready = part(&pieces, None, &()).unwrap();
        assert!(ready.is_some());
        let baked = tempfile::tempdir().unwrap();
        super::part(&pieces, Some(baked.path()), &()).unwrap();
        assert_eq!(
            super::part(&pieces, Some(baked.path()), &Never).unwrap(),
            None
        );
    }
}
