//! The search: evenly first, then around the best.

use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid_bake::progress::Progress;
use rayon::prelude::*;

use super::asks::{Asks, score};
use super::glimpses::Glimpses;
use super::space::{Candidate, Space};
use super::{DirectError, Directed, Found};
use crate::ensemble::{FallEnding, TOGETHER};
use crate::lanes::{Lanes, Task};
use crate::prepared::Prepared;
use crate::scene::Direct;

/// Most falls of a round: what is kept of them is in memory together.
const ROUND: u32 = 1 << 14;
/// Rounds around the best.
const ROUNDS: u32 = 12;
/// How far the first of them draws, in units of the freedom, and what each next has of it.
const SPREAD: f64 = 0.25;
const NARROWER: f64 = 0.6;
/// Parents for each of the best that are wanted.
const PARENTS: usize = 4;
/// How different falls must be, in units of the freedom, to be two of the best.
const DIFFERENT: f64 = 0.1;

/// A candidate that fell.
struct Tried {
    candidate: Candidate,
    fall: Directed,
    score: f64,
    /// Which of two that do what is asked does it more precisely.
    closeness: f64,
}

pub(super) fn search(
    prepared: &Prepared,
    direct: &Direct,
    progress: &dyn Progress,
) -> Result<Found, DirectError> {
    let asks = Asks::new(prepared, direct)?;
    let mut search = Search {
        prepared,
        asks,
        space: Space::new(prepared, direct),
        progress,
        done: AtomicU32::new(0),
        most: direct.falls,
        best: direct.best as usize,
        pool: Vec::new(),
        hits: 0,
        longest: 0.0,
    };
    let drawn = search.draw(direct.falls.div_ceil(2));
    let drawn_hits = search.hits;
    if let Some(share) = direct.steer {
        search.space.steer(prepared, share, search.longest);
    }
    search.refine(direct.falls - direct.falls.div_ceil(2));
    let best = search.different(search.best, DIFFERENT);
    Ok(Found {
        best: best.into_iter().map(|tried| tried.fall.clone()).collect(),
        asks: search.asks.names(),
        falls: search.done.load(Ordering::Relaxed),
        drawn,
        drawn_hits,
        hits: search.hits,
    })
}

struct Search<'a> {
    prepared: &'a Prepared,
    asks: Asks,
    space: Space<'a>,
    progress: &'a dyn Progress,
    done: AtomicU32,
    most: u32,
    best: usize,
    /// The best so far, in order.
    pool: Vec<Tried>,
    hits: u32,
    /// Duration of the longest fall (s).
    longest: f64,
}

impl Search<'_> {
    /// Falls from all the freedom; how many came to an end.
    fn draw(&mut self, falls: u32) -> u32 {
        let mut first = 0;
        while first < falls && !self.progress.cancelled() {
            let end = falls.min(first.saturating_add(ROUND));
            let numbers = first..end;
            let candidates: Vec<_> = numbers.map(|number| self.space.draw(number)).collect();
            self.try_all(&candidates);
            first = end;
        }
        self.done.load(Ordering::Relaxed)
    }

    /// Falls around the best, until there are enough that do what is asked.
    fn refine(&mut self, falls: u32) {
        let mut number = self.most - falls;
        let mut spread = SPREAD;
        for round in 0..ROUNDS {
            let end = number + (self.most - number) / (ROUNDS - round);
            // A large round is made in parts.
            while number < end {
                let part = end.min(number.saturating_add(ROUND));
                if self.progress.cancelled() || self.is_enough() {
                    return;
                }
                let parents = self.different(PARENTS * self.best, 0.5 * spread);
                if parents.is_empty() {
                    return;
                }
                let parents = parents.iter().map(|tried| &tried.candidate).cycle();
                let candidates: Vec<_> = (number..part)
                    .zip(parents)
                    .map(|(number, parent)| self.space.near(parent, spread, number))
                    .collect();
                self.try_all(&candidates);
                number = part;
            }
            spread *= NARROWER;
        }
    }

    fn is_enough(&self) -> bool {
        let best = self.different(self.best, DIFFERENT);
        best.len() == self.best && best.iter().all(|tried| tried.score == 0.0)
    }

    fn try_all(&mut self, candidates: &[Candidate]) {
        let together = candidates.len() / (4 * rayon::current_num_threads());
        let lanes = Lanes {
            prepared: self.prepared,
            apart: 0.0,
        };
        let tried: Vec<Vec<Tried>> = candidates
            .par_chunks(together.clamp(1, TOGETHER))
            .map(|some| self.falls(&lanes, some))
            .collect();
        for tried in tried.into_iter().flatten() {
            self.longest = self.longest.max(tried.fall.last.time);
            self.hits += u32::from(tried.score == 0.0);
            self.pool.push(tried);
        }
        // The sort keeps the order of what is alike, so threads do not matter.
        self.pool.sort_by(|a, b| {
            let by_closeness = || a.closeness.total_cmp(&b.closeness);
            a.score.total_cmp(&b.score).then_with(by_closeness)
        });
        self.pool.truncate(ROUND as usize);
    }

    /// Those falls that did not diverge, nor begin on the ground.
    fn falls(&self, lanes: &Lanes<'_>, candidates: &[Candidate]) -> Vec<Tried> {
        let tasks = candidates.iter().map(|candidate| {
            let release = self.space.release(candidate);
            Task {
                release,
                steering: self.space.steering(candidate),
                watch: Glimpses::new(self.prepared, &release.state),
            }
        });
        let ended = || {
            let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
            let share = f64::from(done) / f64::from(self.most);
            self.progress.report("searching", share);
        };
        let falls = lanes.falls(tasks, &|| self.progress.cancelled(), &ended);
        let falls = falls.into_iter();
        let falls = falls
            .filter(|fall| fall.last.step > 0 && !matches!(fall.ending, FallEnding::Diverged(_)));
        falls
            .map(|fall| {
                let candidate = candidates[fall.place].clone();
                let misses = self.asks.misses(fall.watch, &fall.last, &fall.ending);
                Tried {
                    score: score(&misses),
                    closeness: misses.iter().sum(),
                    fall: Directed {
                        release: fall.release,
                        steering: self.space.steering(&candidate),
                        misses,
                        last: fall.last,
                        ending: fall.ending,
                    },
                    candidate,
                }
            })
            .collect()
    }

    /// So many of the best at most that differ by so much.
    fn different(&self, most: usize, by: f64) -> Vec<&Tried> {
        let mut chosen: Vec<&Tried> = Vec::new();
        for tried in &self.pool {
            if chosen.len() == most {
                break;
            }
            let alike =
                |other: &&Tried| self.space.difference(&other.candidate, &tried.candidate) < by;
            if !chosen.iter().any(alike) {
                chosen.push(tried);
            }
        }
        chosen
    }
}
