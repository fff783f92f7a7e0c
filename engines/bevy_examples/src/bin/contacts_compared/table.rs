//! The table of all layers.

use std::error::Error;

use crate::cards::Way;
use crate::measures::{Landing, Watch};

/// How all cards landed by one contact layer.
pub(crate) struct Layer {
    name: &'static str,
    pub(crate) landings: Vec<Landing>,
}

impl Layer {
    /// Watches all cards; `free` are their ways where there is no ground.
    pub(crate) fn new(
        name: &'static str,
        watch: &Watch,
        ways: &[Way],
        free: &[Way],
    ) -> Result<Self, Box<dyn Error>> {
        let mut landings = Vec::new();
        for (number, (way, free)) in ways.iter().zip(free).enumerate() {
            let landing = watch.landing(number, way, free)?;
            landings.push(landing.ok_or_else(|| format!("{name}: card {number} does not land"))?);
        }
        Ok(Self { name, landings })
    }

    /// The value below which this share of all cards is.
    fn quantile(&self, share: f64, of: impl Fn(&Landing) -> f64) -> f64 {
        let mut values: Vec<f64> = self.landings.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[(share * (values.len() - 1) as f64).round() as usize]
    }

    fn count(&self, of: impl Fn(&Landing) -> bool) -> usize {
        self.landings.iter().filter(|landing| of(landing)).count()
    }
}

/// In Markdown, a column for each layer; the first is what the others are held against.
pub(crate) fn table(layers: &[Layer]) -> String {
    let Some(reference) = layers.first() else {
        return String::new();
    };
    let mut table = Table::new(layers);
    table.row("time to rest: median, nine tenths (s)", |layer| {
        let of = |landing: &Landing| landing.seconds;
        format!(
            "{:.2}, {:.2}",
            layer.quantile(0.5, of),
            layer.quantile(0.9, of)
        )
    });
    table.row("way to rest: median, nine tenths (cm)", |layer| {
        let of = |landing: &Landing| 100.0 * landing.metres;
        format!(
            "{:.1}, {:.1}",
            layer.quantile(0.5, of),
            layer.quantile(0.9, of)
        )
    });
    table.row("energy kept at the first touch: median, largest", |layer| {
        middle_and_largest(layer, |landing| landing.kept)
    });
    table.row("energy added afterwards: median, largest", |layer| {
        middle_and_largest(layer, |landing| landing.added)
    });
    table.row("deepest corner: median, largest (mm)", |layer| {
        middle_and_largest(layer, |landing| 1000.0 * landing.depth)
    });
    table.row("face up, on edge, of all", |layer| {
        let up = layer.count(|landing| landing.upward >= 0.5);
        let on_edge = layer.count(|landing| landing.upward.abs() < 0.5);
        format!("{up}, {on_edge}, {}", layer.landings.len())
    });
    table.row("on the same face as the first column has it", |layer| {
        let pairs = layer.landings.iter().zip(&reference.landings);
        let same = |(a, b): &(&Landing, &Landing)| a.upward * b.upward > 0.0;
        pairs.filter(same).count().to_string()
    });
    table.row("largest difference before the first touch", |layer| {
        format!("{:.0e}", layer.quantile(1.0, |landing| landing.astray))
    });
    table.text
}

fn middle_and_largest(layer: &Layer, of: impl Fn(&Landing) -> f64) -> String {
    let (middle, largest) = (layer.quantile(0.5, &of), layer.quantile(1.0, &of));
    format!("{middle:.2}, {largest:.2}")
}

struct Table<'a> {
    layers: &'a [Layer],
    text: String,
}

impl<'a> Table<'a> {
    fn new(layers: &'a [Layer]) -> Self {
        let text = String::new();
        let mut table = Self { layers, text };
        table.row("", |layer| layer.name.into());
        table.text += &"|---".repeat(layers.len() + 1);
        table.text += "|\n";
        table
    }

    fn row(&mut self, name: &str, cell: impl Fn(&Layer) -> String) {
        let cells: Vec<String> = self.layers.iter().map(cell).collect();
        self.text += &format!("| {name} | {} |\n", cells.join(" | "));
    }
}
