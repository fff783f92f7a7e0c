//! Draws one posed solid: triangles and outlines through a depth buffer with 16 samples a pixel.
//!
//! Outlines have a least width in pixels, so a plate seen exactly along its plane is still drawn.

use std::ops::Range;

use crate::canvas::{Area, Canvas, Point};
use crate::hull::Hull;
use crate::palette::{Colour, PAGE, Paints, mix};
use crate::solid::Solid;
use crate::vector::{Mat3, Vec3, add, dot, mat_vec, normalize, scale};

/// Samples along a side of a pixel.
const SAMPLES: usize = 4;
/// Pixels along a side of a tile: keeps the buffers in the cache, whatever the body's size.
const TILE: usize = 128;
const EMPTY: f32 = f32::NEG_INFINITY;
/// Opacity of what something stands before, of 255.
const VEILED: u32 = 90;
/// Behind everything but in front of nothing: the depth of the clear border.
const BORDER: f32 = f32::MIN;
/// Directions of the light and halfway to the viewer, in right, up, toward the viewer.
const LIGHT: Vec3 = [-0.42, 0.74, 0.525];
const HALFWAY: Vec3 = [-0.2405, 0.4237, 0.8733];

/// A solid as a panel sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    pub solid: &'a Solid,
    /// Body to right, up, toward the viewer.
    pub rotation: Mat3,
    /// Where the solid's centre is on the page.
    pub centre: Point,
    /// Pixels per metre of the body as drawn.
    pub magnified_scale: f64,
    pub outline: f64,
    /// Width of the clear border outside the outline.
    pub border: f64,
    /// How far outlines are drawn before the surface that they bound, pixels.
    pub lift: f64,
    pub paints: Paints,
}

/// What may stand before a solid; nothing by default.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Before<'a> {
    /// Its triangles, their heights toward the viewer on the scale of `Panel::place`.
    pub facets: &'a [Facet],
    /// Height from which on it hides the solid's centre, pixels.
    pub depth: f64,
}

impl View<'_> {
    /// x and y on the page and the height toward the viewer, pixels.
    pub(super) fn place(&self, body_point: Vec3) -> Vec3 {
        let [right, up, toward] = scale(self.magnified_scale, mat_vec(&self.rotation, body_point));
        [self.centre[0] + right, self.centre[1] - up, toward]
    }

    /// The vertices as `place` gives them.
    pub(super) fn points(&self) -> Vec<Vec3> {
        self.solid.vertices.iter().map(|v| self.place(*v)).collect()
    }

    /// What the solid and its outline cover on the page.
    pub(super) fn hull(&self) -> Hull {
        let points = self.solid.vertices.iter().map(|v| self.place(*v));
        Hull::of(points.map(|[x, y, _]| [x, y])).grown(self.outline)
    }

    /// Draws what is within an area of the page; pale where it is behind what stands before it.
    pub(super) fn draw(&self, canvas: &mut Canvas, room: &Area, before: Before<'_>) {
        let scene = Scene::new(self);
        let area = self.hull().area().grown(self.border + 1.0);
        let [low, high] = [area.low, area.high.map(f64::ceil)];
        let pixel = |c: f64, i: usize| c.clamp(room.low[i], room.high[i]) as usize;
        let low: [usize; 2] = std::array::from_fn(|i| pixel(low[i], i));
        let high: [usize; 2] = std::array::from_fn(|i| pixel(high[i], i));
        let veils = before.over(&area);
        for y in (low[1]..high[1]).step_by(TILE) {
            for x in (low[0]..high[0]).step_by(TILE) {
                let size = [TILE.min(high[0] - x), TILE.min(high[1] - y)];
                let mut tile = Tile::new([x, y], size);
                scene.draw(&mut tile);
                veils.iter().for_each(|veil| tile.triangle(veil, Act::Veil));
                tile.resolve(canvas);
            }
        }
    }

    /// The triangles that are seen, if the solid's centre is so high toward the viewer, pixels.
    pub(super) fn facets(&self, depth: f64) -> Vec<Facet> {
        let samples = |[x, y, z]: Vec3| scale(SAMPLES as f64, [x, y, z + depth]);
        let points: Vec<Vec3> = self.points().into_iter().map(samples).collect();
        facets(self, &points)
    }
}

impl Before<'_> {
    /// The triangles over an area of the page, their heights above `depth`.
    fn over(&self, area: &Area) -> Vec<Facet> {
        let samples = SAMPLES as f64;
        let meets = |facet: &&Facet| {
            (0..2).all(|i| {
                let along = facet.corners.map(|corner| corner[i] / samples);
                along.iter().any(|c| *c <= area.high[i]) && along.iter().any(|c| *c >= area.low[i])
            })
        };
        let moved = |facet: &Facet| Facet {
            corners: facet
                .corners
                .map(|[x, y, z]| [x, y, z - samples * self.depth]),
            ..*facet
        };
        self.facets.iter().filter(meets).map(moved).collect()
    }
}

/// The triangles and lines of a view, in samples from the page's corner.
struct Scene {
    triangles: Vec<Facet>,
    lines: Vec<Line>,
    border: f64,
}

/// A triangle as a panel sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Vec3; 3],
    normals: [Vec3; 3],
    thin_axis: Vec3,
    paints: Paints,
}

struct Line {
    ends: [Vec3; 2],
    half_width: f64,
    colour: Colour,
}

impl Scene {
    fn new(view: &View<'_>) -> Self {
        let samples = |p: Vec3| scale(SAMPLES as f64, p);
        let points: Vec<Vec3> = view.points().into_iter().map(samples).collect();
        Self {
            triangles: facets(view, &points),
            lines: lines(view, &points),
            border: view.border * SAMPLES as f64,
        }
    }

    fn draw(&self, tile: &mut Tile) {
        for facet in &self.triangles {
            tile.triangle(facet, Act::Paint);
        }
        for line in &self.lines {
            tile.line(&line.ends, line.half_width, |old, z| {
                (z > old).then_some((z, line.colour))
            });
        }
        for line in &self.lines {
            tile.line(&line.ends, line.half_width + self.border, |old, _| {
                (old == EMPTY).then_some((BORDER, PAGE))
            });
        }
    }
}

fn facets(view: &View<'_>, points: &[Vec3]) -> Vec<Facet> {
    let thin_axis = mat_vec(&view.rotation, view.solid.thin_axis);
    let facet = |face: usize| {
        let toward = dot(view.rotation[2], view.solid.face_normals[face]);
        // The side that is seen, even of a sheet without thickness or a mesh turned inside out.
        let seen = if toward < 0.0 { -1.0 } else { 1.0 };
        let normal = |n: Vec3| scale(seen, mat_vec(&view.rotation, n));
        let visible = toward >= 0.0 || !view.solid.closed;
        let [a, b, c] = view.solid.triangles[face];
        let [na, nb, nc] = view.solid.corner_normals[face];
        visible.then(|| Facet {
            corners: [points[a], points[b], points[c]],
            normals: [normal(na), normal(nb), normal(nc)],
            thin_axis,
            paints: view.paints,
        })
    };
    (0..view.solid.triangles.len()).filter_map(facet).collect()
}

/// The edges that are drawn: folds and borders always, others where they bound what is seen.
fn lines(view: &View<'_>, points: &[Vec3]) -> Vec<Line> {
    let solid = view.solid;
    let faces_viewer = |face: usize| dot(view.rotation[2], solid.face_normals[face]) > 0.0;
    let side = |face: usize| dot(solid.face_normals[face], solid.thin_axis);
    let mut lines = Vec::new();
    for edge in &solid.edges {
        let [a, b] = edge.faces;
        let bounds = a == b || faces_viewer(a) != faces_viewer(b);
        if !bounds && !edge.sharp {
            continue;
        }
        let ends = edge.ends.map(|v| points[v]);
        let flatter = if side(a).abs() > side(b).abs() {
            side(a)
        } else {
            side(b)
        };
        lines.push(line(view, ends, bounds, flatter));
        if a == b {
            // The border of a sheet without thickness belongs to both of its sides.
            lines.push(line(view, ends, bounds, -flatter));
        }
    }
    lines
}

/// A line for an edge of a face that makes an angle with cosine `side` with the thin axis.
///
/// Seen along its plane, a plate is all outline: there the lines take the colours of the two
/// faces and move apart, so that it still shows which is up.
fn line(view: &View<'_>, ends: [Vec3; 2], bounds: bool, side: f64) -> Line {
    let samples = SAMPLES as f64;
    let width = samples * view.outline * if bounds { 1.0 } else { 0.6 };
    let [right, up, _] = mat_vec(&view.rotation, view.solid.thin_axis);
    let tilt = (right * right + up * up).sqrt();
    let flat = ((side.abs() - 0.3) / 0.4).clamp(0.0, 1.0).copysign(side);
    let face = view.paints.face(side);
    // Over the surface the line runs on, which rises toward the viewer beside it.
    let lift = width + samples * view.lift;
    let apart = 0.5 * width * flat;
    Line {
        ends: ends.map(|p| add(p, [apart * right, -apart * up, lift])),
        half_width: 0.5 * width,
        colour: mix(
            view.paints.edge,
            face,
            flat.abs() * (0.15 + 0.65 * tilt * tilt),
        ),
    }
}

/// The colour of a surface with unit normal `normal`, which makes an angle with cosine `side`
/// with the body's thin axis.
fn shade(paints: &Paints, normal: Vec3, side: f64) -> Colour {
    let base = mix(
        paints.rim,
        paints.face(side),
        ((side.abs() - 0.06) / 0.08).clamp(0.0, 1.0),
    );
    let lit = 0.56 + 0.46 * dot(normal, LIGHT).max(0.0) + 0.04 * normal[2];
    let glint = dot(normal, HALFWAY).max(0.0);
    let glint = (0..5).fold(glint, |g, _| g * g);
    let white = mix(base, PAGE, 0.22 * glint);
    white.map(|c| (f64::from(c) * lit).min(255.0) as u8)
}

struct Tile {
    /// First pixel.
    low: [usize; 2],
    /// Pixels.
    size: [usize; 2],
    depth: Vec<f32>,
    colour: Vec<Colour>,
    /// Whether something stands before it.
    veiled: Vec<bool>,
}

/// What a triangle does to the samples that it is before.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Act {
    /// It hides them.
    Paint,
    /// It makes them pale.
    Veil,
}

impl Tile {
    fn new(low: [usize; 2], size: [usize; 2]) -> Self {
        let samples = size[0] * size[1] * SAMPLES * SAMPLES;
        Self {
            low,
            size,
            depth: vec![EMPTY; samples],
            colour: vec![PAGE; samples],
            veiled: vec![false; samples],
        }
    }

    /// The samples of one axis whose centres may lie between two coordinates, and the first's.
    fn range(&self, axis: usize, from: f64, to: f64) -> (Range<usize>, f64) {
        let origin = (self.low[axis] * SAMPLES) as f64 + 0.5;
        let count = self.size[axis] * SAMPLES;
        let clip = |c: f64| (c.max(0.0) as usize).min(count);
        (
            clip((from - origin).floor())..clip((to - origin).ceil() + 1.0),
            origin,
        )
    }

    fn triangle(&mut self, facet: &Facet, act: Act) {
        let Some(plane) = Barycentric::new(&facet.corners) else {
            return;
        };
        let bound = |pick: fn(f64, f64) -> f64, axis: usize| {
            let [a, b, c] = facet.corners.map(|p| p[axis]);
            pick(pick(a, b), c)
        };
        let samples = [0, 1].map(|axis| {
            let (low, high) = (bound(f64::min, axis), bound(f64::max, axis));
            self.range(axis, low, high).0
        });
        let pixels =
            |axis: usize| samples[axis].start / SAMPLES..samples[axis].end.div_ceil(SAMPLES);
        for y in pixels(1) {
            for x in pixels(0) {
                self.triangle_pixel(facet, act, &plane, &samples, [x, y]);
            }
        }
    }

    /// The samples of one pixel that a triangle covers; they share one colour.
    fn triangle_pixel(
        &mut self,
        facet: &Facet,
        act: Act,
        plane: &Barycentric,
        samples: &[Range<usize>; 2],
        pixel: [usize; 2],
    ) {
        let within = |i: usize| {
            let first = pixel[i] * SAMPLES;
            samples[i].start.max(first)..samples[i].end.min(first + SAMPLES)
        };
        let origin = |i: usize| (self.low[i] * SAMPLES) as f64 + 0.5;
        let half = 0.5 * (SAMPLES - 1) as f64;
        let centre = |i: usize| origin(i) + (pixel[i] * SAMPLES) as f64 + half;
        let middle = plane.weights([centre(0), centre(1)]);
        if (0..3).any(|i| middle[i] < -half * plane.steepness[i] - 1e-9) {
            return;
        }
        let origin = [origin(0), origin(1)];
        let mut colour = None;
        for row in within(1) {
            for column in within(0) {
                let at = [origin[0] + column as f64, origin[1] + row as f64];
                let weights = plane.weights(at);
                let index = row * self.size[0] * SAMPLES + column;
                let z = dot(weights, plane.heights) as f32;
                // A little generous, so that no sample falls between two triangles.
                if !weights.iter().all(|w| *w >= -1e-9) || z <= self.depth[index] {
                    continue;
                }
                if act == Act::Veil {
                    self.veiled[index] = true;
                } else {
                    self.depth[index] = z;
                    self.colour[index] = *colour.get_or_insert_with(|| facet.colour(middle));
                }
            }
        }
    }

    /// Visits the samples within `half_width` of a segment; `write` takes the sample's depth and
    /// the segment's there, and gives the new depth and colour.
    fn line(
        &mut self,
        [a, b]: &[Vec3; 2],
        half_width: f64,
        write: impl Fn(f32, f32) -> Option<(f32, Colour)>,
    ) {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length2 = dx * dx + dy * dy;
        let (rows, y0) = self.range(1, a[1].min(b[1]) - half_width, a[1].max(b[1]) + half_width);
        for row in rows {
            let y = y0 + row as f64;
            let [from, to] = strip(*a, *b, half_width, y);
            let (columns, x0) = self.range(0, from, to);
            for column in columns {
                let x = x0 + column as f64;
                let along = (x - a[0]) * dx + (y - a[1]) * dy;
                let t = if length2 > 0.0 {
                    (along / length2).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let (ex, ey) = (x - a[0] - t * dx, y - a[1] - t * dy);
                let index = row * self.size[0] * SAMPLES + column;
                if ex * ex + ey * ey <= half_width * half_width
                    && let Some(sample) =
                        write(self.depth[index], (a[2] + t * (b[2] - a[2])) as f32)
                {
                    (self.depth[index], self.colour[index]) = sample;
                }
            }
        }
    }

    /// Averages the samples of each pixel onto the canvas.
    fn resolve(&self, canvas: &mut Canvas) {
        for y in 0..self.size[1] {
            for x in 0..self.size[0] {
                let over = self.pixel(x, y);
                if over[3] > 0.0 {
                    canvas.blend(self.low[0] + x, self.low[1] + y, over);
                }
            }
        }
    }

    fn pixel(&self, x: usize, y: usize) -> [f32; 4] {
        let mut sum = [0u32; 4];
        for row in y * SAMPLES..(y + 1) * SAMPLES {
            let start = (row * self.size[0] + x) * SAMPLES;
            for index in start..start + SAMPLES {
                if self.depth[index] > EMPTY {
                    let opacity = if self.veiled[index] { VEILED } else { 255 };
                    for (channel, value) in sum.iter_mut().zip(self.colour[index]) {
                        *channel += u32::from(value) * opacity / 255;
                    }
                    sum[3] += opacity;
                }
            }
        }
        let full = (255 * SAMPLES * SAMPLES) as f32;
        sum.map(|s| s as f32 / full)
    }
}

impl Facet {
    /// The colour at the point with the given weights, or at the nearest point of the triangle.
    fn colour(&self, weights: Vec3) -> Colour {
        let mean = |n: Vec3, i: usize| add(n, scale(weights[i].max(0.0), self.normals[i]));
        let normal = normalize((0..3).fold([0.0; 3], mean));
        shade(&self.paints, normal, dot(normal, self.thin_axis))
    }
}

/// The weights of a triangle's corners as functions of x and y.
struct Barycentric {
    /// Corner a, and the gradients of the weights of b and c.
    origin: [f64; 2],
    gradients: [[f64; 2]; 2],
    /// Largest change of each weight over one step in x and one in y.
    steepness: Vec3,
    heights: Vec3,
}

impl Barycentric {
    /// Nothing for a triangle seen along its plane.
    fn new([a, b, c]: &[Vec3; 3]) -> Option<Self> {
        let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        let gradients = [
            [(c[1] - a[1]) / twice_area, (a[0] - c[0]) / twice_area],
            [(a[1] - b[1]) / twice_area, (b[0] - a[0]) / twice_area],
        ];
        let [gb, gc] = gradients;
        let steep = |g: [f64; 2]| g[0].abs() + g[1].abs();
        (twice_area.abs() >= 1e-9).then(|| Self {
            origin: [a[0], a[1]],
            gradients,
            steepness: [steep([gb[0] + gc[0], gb[1] + gc[1]]), steep(gb), steep(gc)],
            heights: [a[2], b[2], c[2]],
        })
    }

    fn weights(&self, [x, y]: [f64; 2]) -> Vec3 {
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let [b, c] = &self.gradients;
        let (wb, wc) = (b[0] * dx + b[1] * dy, c[0] * dx + c[1] * dy);
        [1.0 - wb - wc, wb, wc]
    }
}

/// The x range at height `y` of the strip of points within `half_width` of the line through two
/// points, cut to the segment's own range.
fn strip(a: Vec3, b: Vec3, half_width: f64, y: f64) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let [low, high] = [a[0].min(b[0]) - half_width, a[0].max(b[0]) + half_width];
    if dy.abs() < 1e-9 {
        return [low, high];
    }
    let middle = a[0] + (y - a[1]) * dx / dy;
    let reach = half_width * (dx * dx + dy * dy).sqrt() / dy.abs();
    [low.max(middle - reach), high.min(middle + reach)]
}
