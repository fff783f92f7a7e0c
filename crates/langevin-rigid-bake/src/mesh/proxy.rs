//! A coarser mesh in place of a fine one.

#[cfg(feature = "meshopt")]
mod simplify;

use super::{MeshError, TriMesh};
#[cfg(feature = "meshopt")]
use simplify::simplified;

/// Why there is no proxy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProxyError {
    /// Fewer triangles than any body has.
    #[error("a proxy of {0} triangles cannot enclose a volume; ask for 4 or more, better 1000")]
    TooFew(usize),
    /// The simplified surface is not that of a body.
    #[error(
        "simplified to {triangles} triangles the mesh is no body any more ({error}); ask for more"
    )]
    NoBody {
        /// Triangles that it was simplified to.
        triangles: usize,
        /// What is wrong with it.
        error: MeshError,
    },
    /// The simplifier was left out of this build.
    #[error(
        "this build cannot simplify meshes: build it with the feature `meshopt`, or keep all triangles"
    )]
    NotBuilt,
}

impl TriMesh {
    /// The body in about `triangles` triangles, of the same volume to rounding.
    ///
    /// Edges collapse by quadric error (meshoptimizer by A. Kapoulkine): the vertices are some of those of
    /// this mesh, scaled about their middle to restore the volume. A mesh with no more triangles is
    /// returned as it is; one whose shape or topology needs more keeps more, and so does one whose surface would
    /// pass through itself.
    ///
    /// ```
    /// use langevin_rigid_bake::shapes::Shape;
    /// let fine = Shape::Ellipsoid { semi_axes: [1.0, 2.0, 4.0] }.mesh(5120)?;
    /// let proxy = fine.proxy(1000)?;
    /// assert!(proxy.triangles().len() <= 1000);
    /// assert!((proxy.volume() / fine.volume() - 1.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ProxyError`]: too few triangles are asked for, the result is not the surface of a body, or this build cannot
    /// simplify.
    pub fn proxy(&self, triangles: usize) -> Result<TriMesh, ProxyError> {
        if triangles < 4 {
            return Err(ProxyError::TooFew(triangles));
        }
        if self.triangles.len() <= triangles {
            return Ok(self.clone());
        }
        simplified(self, triangles)
    }
}

#[cfg(not(feature = "meshopt"))]
fn simplified(_: &TriMesh, _: usize) -> Result<TriMesh, ProxyError> {
    Err(ProxyError::NotBuilt)
}

#[cfg(all(test, not(feature = "meshopt")))]
mod tests {
    use super::*;
    use crate::shapes::Shape;

    #[test]
    fn without_the_simplifier_only_what_is_coarse_enough_is_a_proxy() {
        let cube = Shape::Box { size: [1.0; 3] }.mesh(300).unwrap();
        let triangles = cube.triangles().len();
        assert_eq!(cube.proxy(triangles).unwrap(), cube);
        assert_eq!(cube.proxy(triangles - 1), Err(ProxyError::NotBuilt));
    }
}
