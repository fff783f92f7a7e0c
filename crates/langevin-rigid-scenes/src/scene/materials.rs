//! What a body is made of from place to place: regions of another density, and ballast.

use langevin_rigid_bake::mass_properties::{Ballast, Region};
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{BALLAST_MASS, DENSITY, HOLE, PLACE};
use super::raw::{Given, RawBallast, RawBody, RawRegion, given};

/// Most regions of a body. The work grows faster than their number where they overlap.
const MAX_REGIONS: usize = 32;

/// Refuses a centre of mass or an inertia beside what makes them.
pub(super) fn check_stated_once(doc: &Document, body: &RawBody) -> Result<(), SceneError> {
    let maker = match (body.region.is_empty(), body.ballast.is_empty()) {
        (true, true) => return Ok(()),
        (false, _) => "[[body.region]]",
        (true, false) => "[[body.ballast]]",
    };
    let centre = body.centre_of_mass.as_ref().map(Spanned::span);
    let inertia = body.inertia.as_ref().map(Spanned::span);
    for (key, place) in [("centre_of_mass", centre), ("inertia", inertia)] {
        if let Some(place) = place {
            let message =
                format!("`{key}` follows from every {maker}: leave out `{key}`, or every {maker}");
            return Err(doc.error(place, message));
        }
    }
    Ok(())
}

pub(super) fn regions(doc: &Document, body: &RawBody) -> Result<Vec<Region>, SceneError> {
    if let Some(surplus) = body.region.get(MAX_REGIONS) {
        let message = format!(
            "a body has at most {MAX_REGIONS} regions, and this one {}: join some",
            body.region.len()
        );
        return Err(doc.error(surplus.span(), message));
    }
    body.region.iter().map(|raw| region(doc, raw)).collect()
}

fn region(doc: &Document, raw: &Spanned<RawRegion>) -> Result<Region, SceneError> {
    let RawRegion { from, to, density } = raw.get_ref();
    let what = "a region needs";
    let low = needed(doc, raw, from, what, "`from`, its lowest corner (m)")?;
    let high = needed(doc, raw, to, what, "`to`, its highest corner (m)")?;
    let density = needed(doc, raw, density, what, "its `density` (kg/m^3)")?;
    let region = Region {
        from: doc.numbers(low, "from", PLACE)?,
        to: doc.numbers(high, "to", PLACE)?,
        density: doc.number(density, "density", DENSITY)?,
    };
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let (low, high_here) = (region.from[k], region.to[k]);
        if low >= high_here {
            let message = format!(
                "`to` must be above `from` in every coordinate, and its {axis} is {high_here} where that of \
                 `from` is {low}: exchange the two or widen the region"
            );
            return Err(doc.error(high.span(), message));
        }
    }
    Ok(region)
}

pub(super) fn ballast(doc: &Document, body: &RawBody) -> Result<Vec<Ballast>, SceneError> {
    let what = "a ballast needs";
    let one = |raw: &Spanned<RawBallast>| {
        let RawBallast {
            mass,
            position,
            radius,
        } = raw.get_ref();
        let mass = needed(doc, raw, mass, what, "its `mass` (kg)")?;
        let position = needed(doc, raw, position, what, "its `position` (m)")?;
        Ok(Ballast {
            mass: doc.number(mass, "mass", BALLAST_MASS)?,
            position: doc.numbers(position, "position", PLACE)?,
            radius: doc.given(radius, "radius", HOLE)?.unwrap_or(0.0),
        })
    };
    body.ballast.iter().map(one).collect()
}

fn needed<'a, T, R>(
    doc: &Document,
    table: &Spanned<R>,
    value: &'a Given<T>,
    what: &str,
    key: &str,
) -> Result<&'a Spanned<T>, SceneError> {
    value
        .as_ref()
        .ok_or_else(|| doc.error(table.span(), format!("{what} {key}")))
}

pub(super) fn write_region(region: &Region) -> Spanned<RawRegion> {
    Spanned::new(
        0..0,
        RawRegion {
            from: given(region.from.to_vec()),
            to: given(region.to.to_vec()),
            density: given(region.density),
        },
    )
}

pub(super) fn write_ballast(ballast: &Ballast) -> Spanned<RawBallast> {
    Spanned::new(
        0..0,
        RawBallast {
            mass: given(ballast.mass),
            position: given(ballast.position.to_vec()),
            radius: given(ballast.radius),
        },
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use langevin_rigid_bake::body::{BodyBakeError, mass_properties};

    use crate::baking::{self, SceneBakeError};
    use crate::scene::{Scene, SceneError, find};

    /// A scene of a box with these lines in its body.
    fn parse(body: &str) -> Result<Scene, SceneError> {
        let text = format!(
            "fluid.preset = \"water\"\nrun = {{ time_step = 0.01, duration = 1.0 }}\n\
             [body]\nshape = \"box\"\nsize = [0.1, 0.02, 0.04]\n{body}"
        );
        Scene::parse("box", "box.toml", &text)
    }

    const REGION: &str = "[[body.region]]\nfrom = [0, -1, -1]\nto = [1, 1, 1]\ndensity = 3000\n";
    const BALLAST: &str = "[[body.ballast]]\nmass = 0.1\nposition = [0.05, 0, 0]\n";

    #[test]
    fn regions_and_ballast_weigh_and_are_written_as_they_were_read() {
        let scene = parse(&format!(
            "density = 1000\n{REGION}{BALLAST}{BALLAST}radius = 0.01\n"
        ));
        let scene = scene.unwrap();
        let (mesh, _) = baking::mesh(&scene).unwrap();
        let mass = mass_properties(&mesh, &scene.body.spec).unwrap();
        assert!((mass.mass - 0.36).abs() < 1e-12);
        let centre = (0.12 * 0.025 - 0.04 * 0.025 + 0.2 * 0.05) / 0.36;
        assert!((mass.centre_of_mass[0] - centre).abs() < 1e-12);
        let again = Scene::parse("box", "resolved", &scene.to_toml().unwrap()).unwrap();
        assert_eq!(again, scene);
    }

    #[test]
    fn with_a_mass_the_ballast_comes_on_top() {
        let scene = parse(&format!("mass = 0.2\n{REGION}{BALLAST}")).unwrap();
        let (mesh, _) = baking::mesh(&scene).unwrap();
        let mass = mass_properties(&mesh, &scene.body.spec).unwrap();
        assert!((mass.mass - 0.3).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_is_refused_where_it_stands() {
        let region = |from: &str, to: &str, density: &str| {
            format!(
                "density = 1000\n[[body.region]]\nfrom = {from}\nto = {to}\ndensity = {density}\n"
            )
        };
        let ballast = |mass: &str, position: &str, radius: &str| {
            format!(
                "density = 1000\n[[body.ballast]]\nmass = {mass}\nposition = {position}\nradius = {radius}\n"
            )
        };
        let inertia = "inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
        let many = REGION.repeat(33);
        for (body, line, words) in [
            (
                region("[0, 0, 0]", "[1, 1, nan]", "1"),
                9,
                "`to` (m) must be numbers between",
            ),
            (
                region("[0, 0]", "[1, 1, 1]", "1"),
                8,
                "`from` takes 3 values",
            ),
            (
                region("[0, 0, 0]", "[1, 0, 1]", "1"),
                9,
                "its y is 0 where that of `from` is 0",
            ),
            (
                region("[0, 0, 0]", "[1, 1, 1]", "-1"),
                10,
                "`density` (kg/m^3) must be between",
            ),
            (
                region("[1, 1, 1]", "[2, 2, 2]", "1"),
                7,
                "nothing of the body is in region 1",
            ),
            (
                "density = 1\n[[body.region]]\nto = [1, 1, 1]".into(),
                7,
                "needs `from`",
            ),
            (
                "density = 1\n[[body.region]]\nuntil = 1".into(),
                8,
                "unknown field `until`",
            ),
            (
                format!("mass = 0.01\n{REGION}"),
                6,
                "the regions alone weigh",
            ),
            (
                format!("density = 1000\n{many}"),
                135,
                "at most 32 regions, and this one 33",
            ),
            (
                ballast("0", "[0, 0, 0]", "0"),
                8,
                "`mass` (kg) must be between",
            ),
            (
                ballast("1", "[0, inf, 0]", "0"),
                9,
                "`position` (m) must be numbers between",
            ),
            (
                ballast("1", "[0, 0, 0]", "-1"),
                10,
                "`radius` (m) must be between",
            ),
            (
                "density = 1\n[[body.ballast]]\nmass = 1".into(),
                7,
                "needs its `position`",
            ),
            (
                format!("mass = 1\ncentre_of_mass = [0, 0, 0]\n{BALLAST}"),
                7,
                "leave out `centre_of_mass`, or every [[body.ballast]]",
            ),
            (
                format!("mass = 1\n{inertia}\n{REGION}"),
                7,
                "leave out `inertia`, or every [[body.region]]",
            ),
        ] {
            let error = parse(&body).unwrap_err();
            assert!(error.message.contains(words), "{error}");
            assert_eq!(error.line, line, "{error}");
        }
    }

    #[test]
    fn regions_of_a_mesh_file_are_judged_when_it_is_read() {
        let ball = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../langevin-rigid-formats/tests/data/ball-meshopt.glb"
        );
        let text = format!(
            "fluid.preset = \"water\"\nrun = {{ time_step = 0.01, duration = 1.0 }}\n\
             [body]\nmesh = {ball:?}\ndensity = 2000.0\n\
             [[body.region]]\nfrom = [5, 5, 5]\nto = [6, 6, 6]\ndensity = 1\n"
        );
        let scene = Scene::parse("ball", "ball.toml", &text).unwrap();
        let error = baking::bake_scene(&scene, None, &()).unwrap_err();
        assert!(
            matches!(error, SceneBakeError::Body(BodyBakeError::Mass(_))),
            "{error}"
        );
        assert!(
            error
                .to_string()
                .contains("nothing of the body is in region 1")
        );
    }

    #[test]
    fn the_airplane_weighs_where_its_sheet_is_folded() {
        let scene = find("airplane").unwrap();
        let (mesh, _) = baking::mesh(&scene).unwrap();
        let mass = mass_properties(&mesh, &scene.body.spec).unwrap();
        let side = 0.083;
        let sheet = 800.0 * side * side * 1e-4;
        assert!((mass.mass / sheet - 1.0).abs() < 1e-3, "{}", mass.mass);
        // Each sector of the half sheet, out to its rear or its side edge, turned to where it is folded.
        let fold = std::f64::consts::PI / 16.0;
        let sectors = 10_000;
        let (mut area, mut first) = (0.0, 0.0);
        for sector in 0..sectors {
            let angle = (f64::from(sector) + 0.5) * 8.0 * fold / f64::from(sectors);
            let reach = (1.0 / angle.cos()).min(0.5 / angle.sin());
            let folded = (angle % (4.0 * fold) - 2.0 * fold).abs() - fold;
            area += reach * reach;
            first += reach * reach * 2.0 / 3.0 * reach * folded.cos();
        }
        let nose = mesh.bounding_box()[1][0];
        let behind_nose = (nose - mass.centre_of_mass[0]) / side;
        assert!((behind_nose - first / area).abs() < 0.005, "{behind_nose}");
    }

    #[test]
    fn the_maple_seed_weighs_as_its_nut_vein_and_blade() {
        let scene = find("maple-seed").unwrap();
        let (mesh, _) = baking::mesh(&scene).unwrap();
        let mass = mass_properties(&mesh, &scene.body.spec).unwrap();
        assert!((mass.mass / 5.6e-5 - 1.0).abs() < 0.005, "{}", mass.mass);
        // What an earlier estimate of the three gave.
        for (x, estimate) in mass.centre_of_mass.iter().zip([-0.00165, 0.0, 0.000821]) {
            assert!((x - estimate).abs() < 1e-4, "{mass:?}");
        }
        let estimate = [
            (0, 0, 3.119e-10),
            (1, 1, 4.609e-9),
            (2, 2, 4.349e-9),
            (0, 2, 2.953e-10),
        ];
        for (i, j, estimate) in estimate {
            assert!(
                (mass.inertia[i][j] / estimate - 1.0).abs() < 0.05,
                "{mass:?}"
            );
        }
    }
}
