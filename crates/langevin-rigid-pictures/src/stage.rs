//! What stands around the bodies: ground, water, walls, solids.

use crate::Subject;

/// What stands around the bodies, world frame. Of all this as much is drawn as is near the motion.
///
/// ```
/// use langevin_rigid_pictures::{PictureOptions, Stage};
/// let pond = Stage { ground: Some(-1.5), water: Some(0.0), ..Stage::default() };
/// let options = PictureOptions { stage: pond, ..PictureOptions::default() };
/// assert_eq!(options.stage.water, Some(0.0));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stage {
    /// Height of level ground, m.
    pub ground: Option<f64>,
    /// Height of the surface of water, m: the mean where there are waves. Between the walls where there are walls.
    pub water: Option<f64>,
    /// Lowest and highest corner of the upright box whose sides are walls, m. They are drawn as lines.
    pub walls: Option<[[f64; 3]; 2]>,
    /// Slopes, as far as they are within the picture.
    pub planes: Vec<Plane>,
    /// What bodies meet besides. Bodies behind a solid shine through it.
    pub solids: Vec<Scenery>,
}

/// All that is behind a plane, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of it, m.
    pub point: [f64; 3],
    /// Out of the solid, of unit length.
    pub normal: [f64; 3],
}

/// A surface that stays where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenery {
    /// Vertices in the world frame, m.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex indices of each triangle, counterclockwise seen from outside; open surfaces are drawn as well.
    pub triangles: Vec<[u32; 3]>,
}

impl Scenery {
    pub(super) fn subject(&self) -> Subject<'_> {
        Subject {
            vertices: &self.vertices,
            triangles: &self.triangles,
        }
    }
}
