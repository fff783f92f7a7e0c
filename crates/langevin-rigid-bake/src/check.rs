//! A mesh before it is baked: what is wrong with it, which repair mends it, and what its added mass will take.

mod remedy;

pub use remedy::Remedy;

use crate::added_mass::{self, AddedMassError, Expected, expected};
use crate::mesh::{Options, Survey, survey};
use crate::progress::Progress;

/// What a body of too many triangles is simplified to.
const FEWER: usize = 100_000;

/// Everything that `check` of the command and of Python tells.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// What the mesh is and what is wrong with it.
    pub survey: Survey,
    /// What mends it, if it is no body.
    pub remedy: Remedy,
    /// What to expect of the added mass: the mesh's, or where it is no body, that of what the remedy makes of it; nothing
    /// where there is no body either way.
    pub expected: Option<Result<Expected, AddedMassError>>,
}

/// Checks triangles over vertices (m), whatever they are: a mesh never fails to be checked because it is bad. Nothing where
/// `progress` was cancelled.
///
/// ```
/// use langevin_rigid_bake::check::check;
/// use langevin_rigid_bake::mesh::{Options, repair};
/// use langevin_rigid_bake::shapes::Shape;
///
/// // A box without its lid: a hole as wide as that is closed only where it is asked for.
/// let tray = Shape::Box { size: [0.1, 0.05, 0.1] }.mesh(12)?;
/// let vertices = tray.vertices();
/// let lid = |triangle: &[u32; 3]| triangle.iter().all(|&corner| vertices[corner as usize][1] > 0.02);
/// let triangles: Vec<_> = tray.triangles().iter().copied().filter(|t| !lid(t)).collect();
/// let checked = check(vertices, &triangles, &()).ok_or("cancelled")?;
/// assert!(!checked.ready());
/// let options = checked.repair().ok_or("no repair")?;
/// assert_eq!(options, Options { fill: Some(checked.survey.holes[0].edges), ..Options::default() });
/// assert!(repair(vertices, &triangles, &options, &()).body.is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    progress: &dyn Progress,
) -> Option<Checked> {
    let survey = survey(vertices, triangles, progress)?;
    let remedy = match &survey.body {
        Ok(_) => Remedy::default(),
        Err(_) => Remedy::find(vertices, triangles, &survey, progress),
    };
    if progress.cancelled() {
        return None;
    }
    let body = survey.body.as_ref().ok().or(remedy.body.as_ref());
    let foretold = body.map(|body| expected(body, &added_mass::Options::default()));
    Some(Checked {
        survey,
        remedy,
        expected: foretold,
    })
}

impl Checked {
    /// Whether it is a body that can be baked.
    pub fn ready(&self) -> bool {
        self.survey.body.is_ok() && !self.too_large()
    }

    /// Why not, at first sight.
    pub fn fault(&self) -> Option<String> {
        let of_body = self.survey.body.as_ref().err().map(ToString::to_string);
        let of_size = self.expected.as_ref().and_then(|f| f.as_ref().err());
        of_body.or_else(|| of_size.map(ToString::to_string))
    }

    /// The options of [`repair`](crate::mesh::repair()) that make it ready, the mildest that do; nothing where it is, or where
    /// none do. A thickness in them was only tried: how thick a sheet is, its owner knows.
    pub fn repair(&self) -> Option<Options> {
        let too_large = self.too_large();
        let options = self.remedy.options;
        let options = options.or_else(|| too_large.then(Options::default))?;
        Some(Options {
            triangles: too_large.then_some(FEWER),
            ..options
        })
    }

    fn too_large(&self) -> bool {
        self.expected.as_ref().is_some_and(Result::is_err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::repair;
    use crate::shapes::Shape;

    /// Vertices and triangles.
    type Soup = (Vec<[f64; 3]>, Vec<[u32; 3]>);

    fn cube(size: f64, triangles: usize) -> Soup {
        let mesh = Shape::Box { size: [size; 3] }.mesh(triangles).unwrap();
        (mesh.vertices().to_vec(), mesh.triangles().to_vec())
    }

    fn square() -> Soup {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        (corners.to_vec(), vec![[0, 2, 1], [0, 3, 2]])
    }

    fn checked((vertices, triangles): &Soup) -> Checked {
        check(vertices, triangles, &()).unwrap()
    }

    /// Whether its repair does what it promises.
    fn mends(soup: &Soup, options: Options) -> bool {
        repair(&soup.0, &soup.1, &options, &()).body.is_ok()
    }

    #[test]
    fn a_body_is_ready() {
        let checked = checked(&cube(0.1, 300));
        assert!(checked.ready());
        assert_eq!((checked.fault(), checked.repair()), (None, None));
        assert!(matches!(checked.expected, Some(Ok(_))));
    }

    #[test]
    fn what_a_mild_repair_mends_needs_no_options() {
        let mut soup = cube(0.1, 300);
        soup.1.remove(0);
        let checked = checked(&soup);
        assert_eq!(checked.repair(), Some(Options::default()));
        assert_eq!(checked.remedy.sheet, None);
        assert_eq!(checked.remedy.steps.len(), 1);
        assert!(checked.remedy.balance.is_some() && checked.fault().is_some());
        // What comes of it is foretold.
        assert!(matches!(checked.expected, Some(Ok(_))));
        assert!(mends(&soup, Options::default()));
    }

    #[test]
    fn a_wide_hole_may_be_the_rim_of_a_sheet() {
        let tray = Shape::Box {
            size: [0.1, 0.05, 0.1],
        };
        let tray = tray.mesh(12).unwrap();
        let soup = (tray.vertices().to_vec(), tray.triangles().to_vec());
        let lid = |t: &[u32; 3]| t.iter().all(|&corner| soup.0[corner as usize][1] > 0.02);
        let open = soup.1.iter().copied().filter(|t| !lid(t)).collect();
        let soup = (soup.0.clone(), open);
        let checked = checked(&soup);
        let filled = checked.repair().unwrap();
        assert_eq!(filled.fill, Some(checked.survey.holes[0].edges));
        assert_eq!(filled.thickness, None);
        let sheet = checked.remedy.sheet.unwrap();
        assert!(sheet.thickness.is_some() && sheet.fill.is_none());
        assert!(mends(&soup, filled) && mends(&soup, sheet));
    }

    #[test]
    fn a_sheet_is_given_a_thickness_and_no_forecast() {
        let checked = checked(&square());
        let options = checked.repair().unwrap();
        let thickness = options.thickness.unwrap();
        assert!((thickness - 1e-3 * 2f64.sqrt()).abs() < 1e-15);
        assert!(mends(&square(), options));
        assert!(checked.expected.is_none() && checked.remedy.balance.is_none());
    }

    #[test]
    fn debris_is_dropped() {
        let mut soup = cube(0.1, 300);
        let (vertices, triangles) = square();
        let first = soup.0.len() as u32;
        let small = vertices.iter().map(|v| v.map(|x| 1.0 + 1e-3 * x));
        soup.0.extend(small);
        let moved = triangles.iter().map(|t| t.map(|corner| corner + first));
        soup.1.extend(moved);
        let checked = checked(&soup);
        let options = checked.repair().unwrap();
        assert!(options.largest);
        assert!(mends(&soup, options));
    }

    #[test]
    fn what_nothing_mends_says_why() {
        let checked = check(&[[0.0; 3]; 3], &[[0, 1, 2]], &()).unwrap();
        assert_eq!(checked.repair(), None);
        assert!(checked.remedy.left.is_some() && checked.expected.is_none());
    }

    #[test]
    fn a_body_of_too_many_triangles_is_simplified() {
        let mut checked = checked(&cube(0.1, 300));
        checked.expected = Some(Err(AddedMassError::Cancelled));
        assert!(!checked.ready());
        let options = checked.repair().unwrap();
        assert_eq!(options.triangles, Some(FEWER));
        assert!(checked.fault().is_some());
    }

    #[test]
    fn cancelled_work_gives_nothing() {
        struct Never;
        impl Progress for Never {
            fn cancelled(&self) -> bool {
                true
            }
        }
        let mut soup = cube(0.1, 300);
        soup.1.remove(0);
        assert!(check(&soup.0, &soup.1, &Never).is_none());
    }
}
