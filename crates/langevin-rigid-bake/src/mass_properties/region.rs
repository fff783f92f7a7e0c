//! Bodies whose density differs from place to place.

use super::boxes::{Corners, common, without};
use super::clip::moments_within;
use super::{MassError, MassProperties, Moments, check_positive, inertia_of, middle_of};
use crate::mesh::TriMesh;
use crate::mesh::vector::add;

/// A box in which a body has a density of its own. Where regions overlap the last of them counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Lowest corner (m), in the frame of the mesh.
    pub from: [f64; 3],
    /// Highest corner (m).
    pub to: [f64; 3],
    /// Density of the body's solid there (kg/m³).
    pub density: f64,
}

impl MassProperties {
    /// The properties of a body whose solid is of `density` (kg/m³) outside the regions. Without regions, those
    /// of [`MassProperties::of`].
    ///
    /// The regions' parts are cut out of the polyhedron exactly.
    ///
    /// ```
    /// use langevin_rigid_bake::mass_properties::{MassProperties, Region};
    /// use langevin_rigid_bake::shapes::Shape;
    ///
    /// let rod = Shape::Box { size: [1.0, 0.1, 0.1] }.mesh(12)?;
    /// let front = Region { from: [0.0, -1.0, -1.0], to: [1.0, 1.0, 1.0], density: 3000.0 };
    /// let rod = MassProperties::of_regions(&rod, 1000.0, &[front])?;
    /// assert!((rod.mass - 20.0).abs() < 1e-12);
    /// assert!((rod.centre_of_mass[0] - 0.125).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`MassProperties::of`]; [`MassError::RegionCorners`] and [`MassError::EmptyRegion`] for a region that
    /// is no box or holds nothing of the body.
    pub fn of_regions(
        mesh: &TriMesh,
        density: f64,
        regions: &[Region],
    ) -> Result<MassProperties, MassError> {
        let uniform = MassProperties::of(mesh, density)?;
        if regions.is_empty() {
            return Ok(uniform);
        }
        Parts::of(mesh, regions)?.properties(uniform, density)
    }

    /// The same where the `mass` (kg) of the whole is known: the regions have their densities, and what is
    /// outside them weighs the rest.
    ///
    /// # Errors
    ///
    /// As [`MassProperties::of_regions`]; [`MassError::RegionsHoldAll`] where nothing is outside,
    /// [`MassError::RegionsOutweigh`] where the regions alone weigh as much.
    pub fn of_regions_and_mass(
        mesh: &TriMesh,
        mass: f64,
        regions: &[Region],
    ) -> Result<MassProperties, MassError> {
        let uniform = MassProperties::of(mesh, 1.0)?.with_mass(mass)?;
        if regions.is_empty() {
            return Ok(uniform);
        }
        let parts = Parts::of(mesh, regions)?;
        let rest = parts.rest.as_ref().ok_or(MassError::RegionsHoldAll)?;
        let regions = parts.within.iter().map(|(rho, part)| rho * part.volume);
        let regions: f64 = regions.sum();
        if regions >= mass {
            return Err(MassError::RegionsOutweigh { regions, mass });
        }
        let density = (mass - regions) / rest.volume;
        parts.properties(uniform, density)
    }
}

/// A body in parts of one density each.
struct Parts {
    /// Where the moments are about (m).
    middle: [f64; 3],
    /// Outside all regions; none if nothing is.
    rest: Option<Moments>,
    /// Density and moments of what each region holds.
    within: Vec<(f64, Moments)>,
}

/// Share of the volume that rounding may leave outside regions that hold all of a body.
const ROUNDING: f64 = 1e-12;

impl Parts {
    fn of(mesh: &TriMesh, regions: &[Region]) -> Result<Parts, MassError> {
        let middle = middle_of(mesh);
        let [low, high] = mesh.bounding_box();
        let whole = Moments::about(mesh, middle);
        let mut rest = Moments::default();
        rest.add(1.0, &whole);
        let mut within = Vec::with_capacity(regions.len());
        for (i, region) in regions.iter().enumerate() {
            region.check(i)?;
            let own: Vec<Corners> = common([&region.corners(), &[low, high]])
                .into_iter()
                .collect();
            let boxes = regions[i + 1..].iter().fold(own, |boxes, later| {
                let outside = |corners| without(corners, &later.corners());
                boxes.into_iter().flat_map(outside).collect()
            });
            let part = moments_within(mesh, middle, &boxes).ok_or(MassError::EmptyRegion {
                region: i,
                from: region.from,
                to: region.to,
                low,
                high,
            })?;
            rest.add(-1.0, &part);
            within.push((region.density, part));
        }
        let rest = (rest.volume > ROUNDING * whole.volume).then_some(rest);
        Ok(Parts {
            middle,
            rest,
            within,
        })
    }

    /// Those of the whole, with `density` outside the regions (kg/m³); it displaces what the uniform body does.
    fn properties(
        &self,
        uniform: MassProperties,
        density: f64,
    ) -> Result<MassProperties, MassError> {
        let mut mass = Moments::default();
        if let Some(rest) = &self.rest {
            mass.add(density, rest);
        }
        for (density, part) in &self.within {
            mass.add(*density, part);
        }
        let from_middle = mass.centroid();
        MassProperties {
            mass: mass.volume,
            centre_of_mass: add(self.middle, from_middle),
            inertia: inertia_of(&mass, from_middle, 1.0),
            ..uniform
        }
        .within_range()
    }
}

impl Region {
    fn corners(&self) -> Corners {
        [self.from, self.to]
    }

    fn check(&self, region: usize) -> Result<(), MassError> {
        let Region { from, to, density } = *self;
        let finite = [from, to].as_flattened().iter().all(|x| x.is_finite());
        if !finite || (0..3).any(|k| from[k] >= to[k]) {
            return Err(MassError::RegionCorners { region, from, to });
        }
        check_positive("density of a region", density, "kg/m³")
    }
}

#[cfg(test)]
mod tests;
