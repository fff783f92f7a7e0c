//! Line charts as inline SVG, legible on a phone.

use std::fmt::Write;

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 46.0;
const LEGEND_ROW: f64 = 20.0;
/// Letters of a name beyond which the key has one column.
const LONGEST_IN_TWO: usize = 22;

/// Told apart by people who see few colours, too (Okabe and Ito).
const COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

/// Curves over one pair of axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Chart {
    /// What the abscissa is, with its unit.
    pub(crate) x: String,
    /// What the ordinate is, with its unit.
    pub(crate) y: String,
    /// Whether the ordinate is logarithmic; values that are not positive are left out.
    pub(crate) log: bool,
    pub(crate) curves: Vec<Curve>,
}

/// One curve of a chart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) dashed: bool,
    /// Number of its colour; its place among the curves if none.
    pub(crate) colour: Option<usize>,
}

impl Curve {
    pub(crate) fn new(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.into(),
            points,
            dashed: false,
            colour: None,
        }
    }

    pub(crate) fn dashed(self) -> Self {
        Self {
            dashed: true,
            ..self
        }
    }

    pub(crate) fn coloured(self, colour: usize) -> Self {
        Self {
            colour: Some(colour),
            ..self
        }
    }

    fn stroke(&self, place: usize) -> &'static str {
        COLOURS[self.colour.unwrap_or(place) % COLOURS.len()]
    }
}

impl Chart {
    pub(crate) fn new(x: &str, y: &str, curves: Vec<Curve>) -> Self {
        Self {
            x: x.to_owned(),
            y: y.to_owned(),
            log: false,
            curves,
        }
    }

    pub(crate) fn log(self) -> Self {
        Self { log: true, ..self }
    }

    /// The chart as an SVG element.
    pub(crate) fn svg(&self) -> String {
        let curves = self.visible();
        let all = || curves.iter().flat_map(|c| c.points.iter());
        let x = Scale::new(all().map(|p| p[0]), false, [LEFT, WIDTH - RIGHT]);
        let y = Scale::new(all().map(|p| p[1]), self.log, [HEIGHT - BOTTOM, TOP]);
        let longest = curves.iter().map(|c| c.name.chars().count()).max();
        let columns = if longest.unwrap_or(0) > LONGEST_IN_TWO {
            1
        } else {
            2
        };
        let height = HEIGHT + LEGEND_ROW * curves.len().div_ceil(columns) as f64;
        let mut svg = format!(
            r#"<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{} against {}">"#,
            escape(&self.y),
            escape(&self.x)
        );
        self.axes(&mut svg, &x, &y);
        for (k, curve) in curves.iter().enumerate() {
            draw(&mut svg, curve, curve.stroke(k), &x, &y);
            legend(&mut svg, curve, k, columns);
        }
        svg + "</svg>"
    }

    /// The curves without what an axis cannot show.
    fn visible(&self) -> Vec<Curve> {
        let shown = |p: &&[f64; 2]| p.iter().all(|c| c.is_finite()) && (!self.log || p[1] > 0.0);
        let visible = |curve: &Curve| Curve {
            points: curve.points.iter().filter(shown).copied().collect(),
            ..curve.clone()
        };
        self.curves.iter().map(visible).collect()
    }

    fn axes(&self, svg: &mut String, x: &Scale, y: &Scale) {
        let [low, high] = [HEIGHT - BOTTOM, TOP];
        // Writing to a string cannot fail.
        for tick in x.ticks() {
            let at = x.place(tick);
            let _ = write!(
                svg,
                r#"<path class="grid" d="M{at:.1} {low}V{high}"/><text x="{at:.1}" y="{:.1}" text-anchor="middle">{}</text>"#,
                low + 17.0,
                x.label(tick)
            );
        }
        for tick in y.ticks() {
            let at = y.place(tick);
            let _ = write!(
                svg,
                r#"<path class="grid" d="M{LEFT} {at:.1}H{:.1}"/><text x="{:.1}" y="{:.1}" text-anchor="end">{}</text>"#,
                WIDTH - RIGHT,
                LEFT - 6.0,
                at + 4.5,
                y.label(tick)
            );
        }
        let (middle_x, middle_y) = (0.5 * (LEFT + WIDTH - RIGHT), 0.5 * (low + high));
        let _ = write!(
            svg,
            r#"<path class="axis" d="M{LEFT} {high}V{low}H{:.1}"/><text x="{middle_x:.1}" y="{:.1}" text-anchor="middle">{}</text><text transform="translate(14 {middle_y:.1}) rotate(-90)" text-anchor="middle">{}</text>"#,
            WIDTH - RIGHT,
            HEIGHT - 10.0,
            escape(&self.x),
            escape(&self.y)
        );
    }
}

fn draw(svg: &mut String, curve: &Curve, colour: &str, x: &Scale, y: &Scale) {
    let mut path = String::new();
    let mut last: Option<[f64; 2]> = None;
    for p in &curve.points {
        let at = [x.place(p[0]), y.place(p[1])];
        // Points closer than a pixel's fraction only make the page larger.
        let near = |l: &[f64; 2]| (l[0] - at[0]).abs() < 0.4 && (l[1] - at[1]).abs() < 0.4;
        if last.as_ref().is_some_and(near) {
            continue;
        }
        let pen = if last.is_none() { 'M' } else { 'L' };
        let _ = write!(path, "{pen}{:.1} {:.1}", at[0], at[1]);
        last = Some(at);
    }
    let dashes = dashes(curve);
    let _ = write!(
        svg,
        r#"<path class="curve" stroke="{colour}"{dashes} d="{path}"/>"#
    );
}

fn legend(svg: &mut String, curve: &Curve, k: usize, columns: usize) {
    let left = LEFT + 205.0 * (k % columns) as f64;
    let y = HEIGHT + LEGEND_ROW * (k / columns) as f64 + 8.0;
    let (colour, dashes) = (curve.stroke(k), dashes(curve));
    let _ = write!(
        svg,
        r#"<path class="curve" stroke="{colour}"{dashes} d="M{left:.1} {y:.1}h24"/><text x="{:.1}" y="{:.1}">{}</text>"#,
        left + 30.0,
        y + 4.5,
        escape(&curve.name)
    );
}

fn dashes(curve: &Curve) -> &'static str {
    if curve.dashed {
        r#" stroke-dasharray="7 5""#
    } else {
        ""
    }
}

/// Text as HTML and SVG may hold it.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// From values to places on the page.
struct Scale {
    log: bool,
    low: f64,
    high: f64,
    page: [f64; 2],
}

impl Scale {
    fn new(values: impl Iterator<Item = f64>, log: bool, page: [f64; 2]) -> Self {
        let empty = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut low, mut high) = values
            .map(|v| if log { libm::log10(v) } else { v })
            .fold(empty, |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let least = if log { 1.0 } else { 1e-9 * (1.0 + high.abs()) };
        if high - low < least {
            let middle = 0.5 * (low + high);
            (low, high) = (middle - 0.5 * least, middle + 0.5 * least);
        }
        let margin = 0.03 * (high - low);
        if page[1] < page[0] {
            (low, high) = (low - margin, high + margin);
        }
        Self {
            log,
            low,
            high,
            page,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let v = if self.log { libm::log10(value) } else { value };
        let w = (v - self.low) / (self.high - self.low);
        self.page[0] + w * (self.page[1] - self.page[0])
    }

    fn step(&self) -> f64 {
        let wanted = (self.high - self.low) / 6.0;
        if self.log {
            return libm::ceil(wanted);
        }
        let decade = libm::exp10(libm::floor(libm::log10(wanted)));
        [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * decade)
            .into_iter()
            .find(|s| *s >= wanted)
            .unwrap_or(10.0 * decade)
    }

    fn ticks(&self) -> Vec<f64> {
        if self.log && self.high - self.low < 2.0 {
            let decades = (libm::floor(self.low) as i32)..=(libm::ceil(self.high) as i32);
            return decades
                .flat_map(|d| [1.0, 2.0, 5.0].map(|m| m * libm::exp10(f64::from(d))))
                .filter(|t| (self.low..=self.high).contains(&libm::log10(*t)))
                .collect();
        }
        let step = self.step();
        let first = libm::ceil(self.low / step - 1e-9);
        let ticks = (0..20).map(|k| (first + f64::from(k)) * step);
        let ticks = ticks.take_while(|t| *t <= self.high + 1e-9 * step);
        ticks
            .map(|t| if self.log { libm::exp10(t) } else { t })
            .collect()
    }

    fn label(&self, value: f64) -> String {
        let text = if self.log {
            let exponent = libm::floor(libm::log10(value) + 1e-9) as i32;
            if (-2..4).contains(&exponent) {
                format!("{value:.*}", (-exponent).max(0) as usize)
            } else {
                format!("1e{exponent}")
            }
        } else {
            let decimals = (-libm::floor(libm::log10(self.step()) + 1e-9)).clamp(0.0, 9.0);
            format!("{:.*}", decimals as usize, value + 0.0)
        };
        let zero = text
            .trim_start_matches('-')
            .chars()
            .all(|c| "0.".contains(c));
        let text = if zero { text.replace('-', "") } else { text };
        text.replace('-', "\u{2212}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_stays_inside_its_axes() {
        let points = (0..50)
            .map(|i| [f64::from(i), f64::from(i * i) - 300.0])
            .collect();
        let chart = Chart::new("t (s)", "y < 1", vec![Curve::new("a & b", points)]);
        let svg = chart.svg();
        assert!(svg.contains("y &lt; 1") && svg.contains("a &amp; b"));
        let d = svg.split(r#" d="M"#).last().unwrap_or_default();
        assert!(d.starts_with("62"), "{d}");
        let curve = svg
            .split(r##"stroke="#0072b2" d="##)
            .nth(1)
            .unwrap_or_default();
        let curve = curve
            .trim_start_matches('"')
            .split('"')
            .next()
            .unwrap_or_default();
        let mut count = 0;
        for point in curve.split(['M', 'L']).filter(|p| !p.is_empty()) {
            let xy: Vec<f64> = point.split(' ').map(|c| c.parse().unwrap()).collect();
            assert!((LEFT..=WIDTH - RIGHT).contains(&xy[0]), "{point}");
            assert!((TOP..=HEIGHT - BOTTOM).contains(&xy[1]), "{point}");
            count += 1;
        }
        assert_eq!(count, 50);
    }

    #[test]
    fn nothing_and_constants_and_logarithms_have_axes_too() {
        for points in [vec![], vec![[0.0, 5.0]], vec![[0.0, f64::NAN], [1.0, -1.0]]] {
            let chart = Chart::new("x", "y", vec![Curve::new("c", points)]);
            assert!(!chart.svg().contains("NaN") && !chart.clone().log().svg().contains("NaN"));
        }
    }
}
