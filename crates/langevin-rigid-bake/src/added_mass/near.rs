//! Pairs of triangles near each other: which they are, and their exact moments.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::AddedMassError;
use super::kernel::{PairMoments, Potential, Rule, own, pair};
use super::panels::{Panel, Panels, Vec3};
use super::report::{Cancel, check_memory};
use super::sums::{RowSums, rotational};
use crate::mesh::vector::{bounding_box, dot, sub};

/// Squared centroid distance, in longest edges, below which a pair is integrated exactly. Off the
/// ratios regular meshes have, so that rounding never decides.
pub(super) const NEAR2: f64 = 2.013 * 2.013;
/// The same for the finer outer rule.
const TOUCHING2: f64 = 1.017 * 1.017;
/// Gap of opposite panels, in longest edges, below which a body counts as a sheet.
const SHEET_GAP: f64 = 0.3017;
const GROUP: usize = 32;
/// Pairs, both ways, whose moments are kept at a time.
const BATCH: usize = 1 << 22;
/// Most near pairs, both ways: even meshes of a million triangles have fewer.
const MOST_PAIRS: u64 = 120_000_000;
/// What a pair takes: column and value, and the column again while pairs are found.
const PAIR_BYTES: u64 = 16;

/// Near pairs of a mesh, each row sorted, the diagonal included.
pub(super) struct NearPairs {
    start: Vec<usize>,
    columns: Vec<u32>,
    /// II 1/r of every entry; empty until integrated.
    values: Vec<f64>,
}

impl NearPairs {
    /// Finds the pairs; a row depends on that row alone, and (a, b) is there if (b, a) is.
    pub(super) fn find(panels: &[Panel], cancel: &Cancel) -> Result<NearPairs, AddedMassError> {
        let groups: Vec<Group> = panels.chunks(GROUP).map(Group::new).collect();
        let runs: Vec<Group> = panels.chunks(GROUP * GROUP).map(Group::new).collect();
        let total = AtomicUsize::new(0);
        let rows: Vec<Vec<u32>> = panels
            .par_iter()
            .with_min_len(64)
            .map(|a| {
                cancel.check()?;
                let row = near_row(a, panels, &groups, &runs);
                let pairs = total.fetch_add(row.len(), Ordering::Relaxed) + row.len();
                check_memory(pairs as u64 * PAIR_BYTES, MOST_PAIRS * PAIR_BYTES)?;
                Ok(row)
            })
            .collect::<Result<_, AddedMassError>>()?;
        let mut start = Vec::with_capacity(rows.len() + 1);
        start.push(0);
        for row in &rows {
            start.push(start[start.len() - 1] + row.len());
        }
        Ok(NearPairs {
            start,
            columns: rows.concat(),
            values: Vec::new(),
        })
    }

    /// The panels near panel `a` and the integrals of 1/r with them.
    pub(super) fn row(&self, a: usize) -> (&[u32], &[f64]) {
        let range = self.start[a]..self.start[a + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// How many there are, both ways.
    pub(super) fn count(&self) -> usize {
        self.columns.len()
    }

    fn columns(&self, a: usize) -> &[u32] {
        &self.columns[self.start[a]..self.start[a + 1]]
    }

    /// Runs of rows with some [`BATCH`] pairs each.
    fn batches(&self) -> Vec<Range<usize>> {
        let rows = self.start.len() - 1;
        let mut batches = Vec::new();
        let mut first = 0;
        while first < rows {
            let full = self
                .start
                .partition_point(|&s| s < self.start[first] + BATCH);
            let end = full.clamp(first + 1, rows);
            batches.push(first..end);
            first = end;
        }
        batches
    }

    /// A number for each pair, row by row.
    fn split<'a>(&self, mut values: &'a mut [f64]) -> Vec<&'a mut [f64]> {
        let lengths = self.start.windows(2).map(|ends| ends[1] - ends[0]);
        lengths
            .map(|length| values.split_off_mut(..length).unwrap_or_default())
            .collect()
    }

    /// The near panels that come after `a`, itself first.
    fn upper(&self, a: usize) -> &[u32] {
        let row = self.columns(a);
        &row[row.partition_point(|&b| (b as usize) < a)..]
    }
}

/// A run of panels, for skipping many at once.
struct Group {
    bounds: [Vec3; 2],
    longest2: f64,
}

impl Group {
    fn new(panels: &[Panel]) -> Group {
        let centroids: Vec<Vec3> = panels.iter().map(|p| p.centroid).collect();
        Group {
            bounds: bounding_box(&centroids),
            longest2: panels.iter().fold(0.0, |l, p| l.max(p.longest2)),
        }
    }

    fn may_be_near(&self, a: &Panel) -> bool {
        let [low, high] = self.bounds;
        let outside: Vec3 = std::array::from_fn(|k| {
            (low[k] - a.centroid[k])
                .max(a.centroid[k] - high[k])
                .max(0.0)
        });
        let reach2 = NEAR2 * self.longest2.max(a.longest2);
        dot(outside, outside) <= reach2 * (1.0 + 1e-12)
    }
}

fn near_row(a: &Panel, panels: &[Panel], groups: &[Group], runs: &[Group]) -> Vec<u32> {
    let mut row = Vec::with_capacity(96);
    let runs = groups.chunks(GROUP).zip(runs).enumerate();
    let close = runs
        .filter(|(_, (_, run))| run.may_be_near(a))
        .flat_map(|(r, (groups, _))| {
            groups
                .iter()
                .enumerate()
                .map(move |(g, group)| (r * GROUP + g, group))
        });
    for (g, group) in close {
        if !group.may_be_near(a) {
            continue;
        }
        let first = g * GROUP;
        let members = panels[first..].iter().take(GROUP).enumerate();
        row.extend(
            members
                .filter(|(_, b)| ratio2(a, b) < NEAR2)
                .map(|(i, _)| (first + i) as u32),
        );
    }
    row
}

/// Squared distance over squared longest edge, the same bits for (a, b) and (b, a).
fn ratio2(a: &Panel, b: &Panel) -> f64 {
    let d = sub(b.centroid, a.centroid);
    dot(d, d) / a.longest2.max(b.longest2)
}

/// What the near pairs say of a body's thickness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thickness {
    /// Whether panels face each other across less than about 0.3 of their longest edge.
    pub(super) sheet: bool,
    /// Smallest gap between facing panels over their longest edge; infinite where none face.
    pub(super) ratio: f64,
}

/// Looks for panels that face each other across a thin body or a narrow slot.
pub(super) fn thickness(panels: &[Panel], pairs: &NearPairs) -> Thickness {
    let of_panel = |(a, panel): (usize, &Panel)| {
        facing(a, panels, pairs)
            .map(|f| f.gap / panel.longest2.max(panels[f.panel].longest2).sqrt())
            .fold(f64::INFINITY, f64::min)
    };
    let ratio = panels
        .par_iter()
        .enumerate()
        .map(of_panel)
        .reduce(|| f64::INFINITY, f64::min);
    Thickness {
        sheet: ratio < SHEET_GAP,
        ratio,
    }
}

/// A panel opposite another one.
pub(super) struct Facing {
    pub(super) panel: usize,
    /// Distance of the planes at the centroids.
    pub(super) gap: f64,
    /// Whether the body is between the two, rather than fluid.
    pub(super) through_body: bool,
}

/// The panels near `a` that look the other way, lie over it and share no vertex with it.
pub(super) fn facing<'a>(
    a: usize,
    panels: &'a [Panel],
    pairs: &'a NearPairs,
) -> impl Iterator<Item = Facing> + 'a {
    let panel = &panels[a];
    pairs
        .columns(a)
        .iter()
        .map(|&b| b as usize)
        .filter_map(move |b| {
            let other = &panels[b];
            let opposite = dot(panel.normal, other.normal) < -0.517;
            let apart = !panel.corners.iter().any(|v| other.corners.contains(v));
            let close = opposite && apart && ratio2(panel, other) < TOUCHING2;
            if !close || !(panel.covers(other.centroid) || other.covers(panel.centroid)) {
                return None;
            }
            let offset = dot(panel.normal, sub(other.centroid, panel.centroid));
            let back = dot(other.normal, sub(panel.centroid, other.centroid));
            let gap = offset.abs().max(back.abs());
            Some(Facing {
                panel: b,
                gap,
                through_body: offset < 0.0,
            })
        })
}

/// Integrates the near pairs: their values are kept, the sums they add to each row returned.
pub(super) fn integrate(
    panels: &Panels,
    pairs: &mut NearPairs,
    sheet: bool,
    cancel: &Cancel,
) -> Result<Vec<RowSums>, AddedMassError> {
    let panels = &panels.panels;
    let potentials: Vec<Potential> = panels.iter().map(Potential::new).collect();
    let rules = Rules::new(sheet);
    let mut sums = vec![RowSums::default(); panels.len()];
    let mut values = vec![0.0; pairs.columns.len()];
    for rows in pairs.batches() {
        let batch = Batch::new(rows, panels, &potentials, pairs, &rules, cancel)?;
        let later = sums.par_iter_mut().zip(pairs.split(&mut values));
        later
            .enumerate()
            .skip(batch.rows.start)
            .with_min_len(64)
            .for_each(|(a, (sums, values))| batch.add(a, panels, pairs, sums, values));
        cancel.report(batch.rows.end as f64 / panels.len() as f64);
    }
    pairs.values = values;
    Ok(sums)
}

/// The outer quadrature of touching pairs and of the others.
struct Rules {
    close: Rule,
    middle: Rule,
}

impl Rules {
    fn new(sheet: bool) -> Rules {
        let close = if sheet {
            Rule::twenty_four()
        } else {
            Rule::seven()
        };
        Rules {
            close,
            middle: Rule::three(),
        }
    }
}

/// The moments of a run of rows with the panels after each: all of them at once would take ten times the
/// memory of the values.
struct Batch {
    rows: Range<usize>,
    upper: Vec<Vec<PairMoments>>,
}

impl Batch {
    fn new(
        rows: Range<usize>,
        panels: &[Panel],
        potentials: &[Potential],
        pairs: &NearPairs,
        rules: &Rules,
        cancel: &Cancel,
    ) -> Result<Batch, AddedMassError> {
        let moments = |a: usize, b: usize| {
            if b == a {
                return own(&potentials[a], &rules.close);
            }
            let touching = ratio2(&panels[a], &panels[b]) < TOUCHING2;
            let rule = if touching {
                &rules.close
            } else {
                &rules.middle
            };
            pair(&potentials[a], &potentials[b], rule)
        };
        let upper = rows
            .clone()
            .into_par_iter()
            .with_min_len(16)
            .map(|a| {
                cancel.check()?;
                let row = pairs.upper(a).iter();
                Ok(row.map(|&b| moments(a, b as usize)).collect())
            })
            .collect::<Result<_, AddedMassError>>()?;
        Ok(Batch { rows, upper })
    }

    /// Adds to row `a`, in this batch or after it, what the pairs of the batch are to it, in the order of
    /// the columns.
    fn add(
        &self,
        a: usize,
        panels: &[Panel],
        pairs: &NearPairs,
        sums: &mut RowSums,
        values: &mut [f64],
    ) {
        let columns = pairs.columns(a);
        let from = position(columns, self.rows.start);
        let to = if self.rows.contains(&a) {
            columns.len()
        } else {
            position(columns, self.rows.end)
        };
        for (&b, value) in columns[from..to].iter().zip(&mut values[from..to]) {
            let b = b as usize;
            let upper =
                |a: usize, b: usize| &self.upper[a - self.rows.start][position(pairs.upper(a), b)];
            let moments = if b >= a {
                *upper(a, b)
            } else {
                upper(b, a).swapped()
            };
            sums.add_near(&moments, panels[b].normal);
            sums.add_energy(rotational(panels[a].normal, panels[b].normal, &moments.xy));
            *value = moments.p;
        }
    }
}

fn position(row: &[u32], b: usize) -> usize {
    row.partition_point(|&c| (c as usize) < b)
}
