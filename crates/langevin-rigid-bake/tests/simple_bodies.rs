//! Bodies without a mesh against the bake of meshes of the same shape.
//!
//! Closed forms and fits have to give what the boundary elements give, field by field, over the range of
//! proportions that their documentation claims, within the errors that it states. Errors of tensors are of
//! each diagonal entry, or of the largest where an entry is much smaller and neither side is accurate.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;

use langevin_rigid::Body;
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;

const DENSITY: f64 = 700.0;

fn baked(shape: Shape, triangles: usize) -> Body {
    let spec = BodySpec {
        density: Some(DENSITY),
        ..BodySpec::default()
    };
    let mesh = shape.mesh(triangles).unwrap();
    bake_body(&mesh, &spec, &()).unwrap().0
}

fn largest<const N: usize>(tensor: &[[f64; N]; N], range: std::ops::Range<usize>) -> f64 {
    range.map(|i| tensor[i][i]).fold(0.0, f64::max)
}

/// The largest errors found, by field.
#[derive(Default)]
struct Errors(BTreeMap<&'static str, f64>);

impl Errors {
    fn note(&mut self, field: &'static str, error: f64) {
        let worst = self.0.entry(field).or_default();
        // Keeps what is not a number.
        if error.abs() > *worst || error.is_nan() {
            *worst = error.abs();
        }
    }

    fn relative(&mut self, field: &'static str, found: f64, wanted: f64) {
        self.note(field, found / wanted - 1.0);
    }

    /// Diagonal entries in `range`, each against itself or, where that is more, against `least`.
    fn entries<const N: usize>(
        &mut self,
        field: &'static str,
        [found, wanted]: [&[[f64; N]; N]; 2],
        range: std::ops::Range<usize>,
        least: f64,
    ) {
        for i in range {
            let error = (found[i][i] - wanted[i][i]) / wanted[i][i].max(least);
            self.note(field, error);
        }
    }

    fn compare(&mut self, found: &Body, shape: Shape, triangles: usize) {
        let wanted = baked(shape, triangles);
        self.relative("mass", found.mass, wanted.mass);
        self.relative("volume", found.volume, wanted.volume);
        self.entries("inertia", [&found.inertia, &wanted.inertia], 0..3, 0.0);
        let added = [&found.added_mass, &wanted.added_mass];
        let least = 0.1 * largest(&wanted.added_mass, 0..3);
        self.entries("translational added mass", added, 0..3, least);
        let displaced = largest(&wanted.inertia, 0..3) / DENSITY;
        let least = 0.1 * largest(&wanted.added_mass, 3..6).max(displaced);
        self.entries("rotational added mass", added, 3..6, least);
        for i in 0..3 {
            let (found, wanted) = (found.half_extents[i], wanted.half_extents[i]);
            self.relative("half extents", found, wanted);
        }
        self.relative("thickness", found.thickness, wanted.thickness);
        self.relative("length", found.length, wanted.length);
        let (f, w) = (&found.separation, &wanted.separation);
        let least = largest(&w.drag_area, 0..3);
        self.entries("drag areas", [&f.drag_area, &w.drag_area], 0..3, least);
        self.entries("extents", [&f.extents, &w.extents], 0..3, 0.0);
        let stokes = [&f.stokes_translation, &w.stokes_translation];
        self.entries("Stokes resistance", stokes, 0..3, 0.0);
        let stokes = [&f.stokes_rotation, &w.stokes_rotation];
        self.entries("Stokes resistance", stokes, 0..3, 0.0);
        assert_eq!(found.slices.len(), wanted.slices.len(), "{shape:?}");
        let offset = |body: &Body| {
            body.centre_of_buoyancy
                .iter()
                .fold(0.0f64, |a, r| a.max(r.abs()))
        };
        self.note("centre of buoyancy", offset(found) / found.length);
        let pitch = found.length / found.slices.len() as f64;
        let mut wanted_slices = wanted.slices.clone();
        // The axis of a mesh has no sense.
        let along = |p: &langevin_rigid::Slice| p.centre.iter().sum::<f64>();
        wanted_slices.sort_by(|a, b| along(a).total_cmp(&along(b)));
        for (f, w) in found.slices.iter().zip(&wanted_slices) {
            for i in 0..3 {
                self.note("slices' centres", (f.centre[i] - w.centre[i]) / pitch);
            }
            let least = 0.3 * largest(&w.translation, 0..3);
            let pair = [&f.translation, &w.translation];
            self.entries("slices' added mass", pair, 0..3, least);
            let least = 0.3 * largest(&w.rotation, 0..3);
            self.entries("slices' rotation", [&f.rotation, &w.rotation], 0..3, least);
            let least = largest(&w.drag_area, 0..3);
            let pair = [&f.drag_area, &w.drag_area];
            self.entries("slices' drag areas", pair, 0..3, least);
            self.entries("slices' extents", [&f.extents, &w.extents], 0..3, 0.0);
        }
    }

    fn assert(self, limits: &[(&str, f64)]) {
        for (field, worst) in &self.0 {
            let limit = limits.iter().find(|l| l.0 == *field).map_or(0.01, |l| l.1);
            assert!(
                *worst <= limit,
                "{field}: {worst:.4}, of all {:.4?}",
                self.0
            );
        }
    }
}

#[test]
fn ellipsoids_are_as_baked() {
    let mut errors = Errors::default();
    for semi_axes in [
        [0.1, 0.1, 0.1],
        [0.1, 0.05, 0.2],
        [0.1, 0.02, 0.1],
        [0.1, 0.002, 0.1],
        [0.03, 0.1, 0.03],
        [0.1, 0.01, 0.04],
        [0.01, 0.01, 0.1],
        [0.01, 0.3, 0.002],
    ] {
        let body = Body::ellipsoid(semi_axes, DENSITY).unwrap();
        errors.compare(&body, Shape::Ellipsoid { semi_axes }, 5120);
    }
    errors.assert(&[
        ("translational added mass", 0.002),
        ("rotational added mass", 0.002),
        ("drag areas", 0.003),
        ("slices' added mass", 0.02),
        ("slices' rotation", 0.03),
        ("slices' drag areas", 0.02),
        // A thickness is the width of a few facets.
        ("slices' extents", 0.03),
    ]);
}

#[test]
fn cylinders_are_as_baked() {
    let mut errors = Errors::default();
    for ratio in [0.01, 0.03, 0.1, 0.3, 0.8] {
        let (radius, thickness) = (0.1, 0.1 * ratio);
        let body = Body::disc(radius, thickness, DENSITY).unwrap();
        errors.compare(&body, Shape::Disc { radius, thickness }, 1280);
    }
    for ratio in [1.0, 2.0, 3.5, 4.6, 6.2, 8.4, 18.0, 40.0] {
        let (radius, height) = (0.1, 0.1 * ratio);
        let body = Body::cylinder(radius, height, DENSITY).unwrap();
        // A long cylinder of few triangles is a prism of few sides.
        let triangles = if ratio > 10.0 { 4000 } else { 1280 };
        errors.compare(&body, Shape::Cylinder { radius, height }, triangles);
    }
    errors.assert(&[
        ("translational added mass", 0.015),
        ("drag areas", 0.02),
        ("extents", 0.015),
        ("Stokes resistance", 0.015),
        ("slices' added mass", 0.02),
        ("slices' rotation", 0.2),
        ("slices' drag areas", 0.04),
    ]);
}

#[test]
fn boxes_are_as_baked() {
    let mut errors = Errors::default();
    for size in [
        [0.1, 0.1, 0.1],
        [0.1, 0.07, 0.1],
        [0.1, 0.02, 0.05],
        [0.02, 0.1, 0.1],
        [0.03, 0.03, 0.1],
        [0.2, 0.01, 0.01],
        [0.1, 0.01, 0.03],
        [0.04, 0.5, 0.02],
        [0.25, 0.01, 0.01],
        [0.01, 0.004, 0.25],
        [0.1, 0.06, 0.08],
        [0.1, 0.025, 0.1],
        [0.08, 0.1, 0.35],
    ] {
        let body = Body::cuboid(size, DENSITY).unwrap();
        // The edges of a long lath of few triangles are coarse.
        let triangles = if size.contains(&0.004) { 5000 } else { 1280 };
        errors.compare(&body, Shape::Box { size }, triangles);
    }
    for [length, width, thickness] in [
        [0.1, 0.1, 0.001],
        [0.2, 0.1, 0.001],
        [0.3, 0.03, 0.003],
        [0.05, 0.2, 0.002],
        [0.1, 0.08, 0.004],
    ] {
        let body = Body::plate(length, width, thickness, DENSITY).unwrap();
        let size = [length, thickness, width];
        errors.compare(&body, Shape::Box { size }, 1280);
    }
    errors.assert(&[
        ("translational added mass", 0.03),
        ("rotational added mass", 0.05),
        ("drag areas", 0.07),
        ("slices' centres", 0.02),
        ("slices' added mass", 0.04),
        ("slices' rotation", 0.32),
        ("slices' drag areas", 0.08),
    ]);
}
