//! Impulses that keep the bodies of an island apart, and the moves that mend what overlap is left.
//!
//! Impulses change velocities by the inverse of the whole 6x6 mass of body and fluid. Projected Gauss-Seidel over normal
//! and friction impulses (Coulomb's disc), from those of the step before. Without friction each sweep lowers
//! 1/2 l.A l + l.v, which is the kinetic energy that the impulses l add to bodies that approach at v; what friction, a
//! restitution or old impulses would add is taken off at the end: contacts never add energy.

use langevin_rigid::linalg::Mat6;
use parry3d_f64::math::{Matrix, Rotation, Vector};

/// Sweeps over all contacts at most, and as many of these as go over so many contacts altogether: few bodies are solved
/// well, of many bodies what is left of a step is solved in the next.
const SWEEPS: [usize; 2] = [40, 100];
const WORK: usize = 8000;
/// Over-relaxation of the normal impulses: what is pushed settles in fewer sweeps, and below 2 each still lowers the energy.
const OVER: f64 = 1.3;
/// Sweeps that find how bodies bounce.
const BOUNCING_SWEEPS: usize = 10;
/// Sweeps that mend overlap.
const MENDING_SWEEPS: usize = 10;
/// Share of the overlap at the begin of a step that is mended in it.
const MENDED: f64 = 0.5;

/// Speeds are found to this share of the fastest approach, where that is coarser than the rules.
const ROUNDING: f64 = 1e-6;

/// A linear and an angular part, world frame.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Twist {
    pub(crate) linear: Vector,
    pub(crate) angular: Vector,
}

impl Twist {
    fn times(&self, factor: f64) -> Self {
        Self {
            linear: self.linear * factor,
            angular: self.angular * factor,
        }
    }

    /// Where a point at `arm` from the centre goes.
    fn displacement(&self, arm: Vector) -> Vector {
        let turn = self.angular;
        let angle = turn.length_squared();
        let across = turn.cross(arm);
        // Rodrigues's formula, and its first terms where they will do.
        let (first, second) = if angle < 1e-4 {
            (1.0 - angle / 6.0, 0.5 - angle / 24.0)
        } else {
            let length = angle.sqrt();
            (
                libm::sin(length) / length,
                (1.0 - libm::cos(length)) / angle,
            )
        };
        self.linear + across * first + turn.cross(across) * second
    }

    fn add_scaled(&mut self, factor: f64, other: &Self) {
        self.linear += other.linear * factor;
        self.angular += other.angular * factor;
    }
}

/// Inverse of the total mass, world frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InverseMass {
    linear: Matrix,
    mixed: Matrix,
    angular: Matrix,
}

impl InverseMass {
    /// That of the body frame, turned into the world's.
    pub(crate) fn new(of_body: &Mat6, rotation: Rotation) -> Self {
        let turn = Matrix::from_quat(rotation);
        let block = |row: usize, column: usize| {
            let entry = |i: usize, j: usize| of_body[row + i][column + j];
            let columns = |j: usize| Vector::new(entry(0, j), entry(1, j), entry(2, j));
            turn * Matrix::from_cols(columns(0), columns(1), columns(2)) * turn.transpose()
        };
        Self {
            linear: block(0, 0),
            mixed: block(0, 3),
            angular: block(3, 3),
        }
    }

    /// The change of velocity by an impulse `direction` whose moment is `moment`.
    fn times(&self, direction: Vector, moment: Vector) -> Twist {
        Twist {
            linear: self.linear * direction + self.mixed * moment,
            angular: self.mixed.transpose() * direction + self.angular * moment,
        }
    }
}

/// A body that contacts can move.
#[derive(Debug, Clone)]
pub(crate) struct Mover {
    pub(crate) inverse_mass: InverseMass,
    pub(crate) velocity: Twist,
    /// Where it goes in this step, if a contact pushes it (m, rad).
    pub(crate) way: Option<Twist>,
}

/// A contact of one pair of points.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    /// Which mover is pushed backwards; none is what stands still.
    pub(crate) a: Option<usize>,
    /// Which is pushed along the normal.
    pub(crate) b: Option<usize>,
    pub(crate) normal: Vector,
    /// From the centres of mass to the points (m).
    pub(crate) arm_a: Vector,
    pub(crate) arm_b: Vector,
    /// Gap at the begin of the step (m), less what is kept.
    pub(crate) gap: f64,
    /// Gap that is kept (m): half of it may be used up without being mended.
    pub(crate) skin: f64,
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    /// Impulse on b, world frame (N s): that of the step before, then that of this one.
    pub(crate) impulse: Vector,
}

/// How a step is solved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rules {
    /// Time step (s).
    pub(crate) dt: f64,
    /// Speeds are found to this (m/s).
    pub(crate) tolerance: f64,
    /// Slower than this nothing bounces (m/s).
    pub(crate) bounce: f64,
}

/// One direction of a contact.
struct Row {
    direction: Vector,
    moment_a: Vector,
    moment_b: Vector,
    /// Changes of velocity by a unit impulse.
    push_a: Twist,
    push_b: Twist,
    /// Impulse for a unit of relative speed (kg).
    mass: f64,
    impulse: f64,
    /// Relative speed before contact (m/s).
    before: f64,
}

impl Row {
    fn new(contact: &Contact, direction: Vector, movers: &[Mover]) -> Self {
        let (moment_a, moment_b) = (
            contact.arm_a.cross(direction),
            contact.arm_b.cross(direction),
        );
        let push = |mover: Option<usize>, moment| {
            mover.map_or_else(Twist::default, |i| {
                movers[i].inverse_mass.times(direction, moment)
            })
        };
        let (push_a, push_b) = (push(contact.a, moment_a), push(contact.b, moment_b));
        let mut row = Self {
            direction,
            moment_a,
            moment_b,
            push_a,
            push_b,
            mass: 0.0,
            impulse: 0.0,
            before: 0.0,
        };
        let compliance = row.compliance(&row);
        row.mass = if compliance > 0.0 {
            1.0 / compliance
        } else {
            0.0
        };
        row
    }

    /// Relative speed along this by a unit impulse along another row of the contact (1/kg).
    fn compliance(&self, other: &Self) -> f64 {
        let response =
            |push: &Twist, moment| self.direction.dot(push.linear) + push.angular.dot(moment);
        response(&other.push_a, self.moment_a) + response(&other.push_b, self.moment_b)
    }

    /// Speed of b relative to a along the direction, where `of` says how a mover moves.
    fn speed(&self, contact: &Contact, movers: &[Mover], of: impl Fn(&Mover) -> Twist) -> f64 {
        let part = |mover: Option<usize>, moment: Vector| {
            mover.map_or(0.0, |i| {
                let twist = of(&movers[i]);
                self.direction.dot(twist.linear) + moment.dot(twist.angular)
            })
        };
        part(contact.b, self.moment_b) - part(contact.a, self.moment_a)
    }

    /// Gives both movers so much of a unit impulse, in what `of` chooses.
    fn push(
        &self,
        contact: &Contact,
        movers: &mut [Mover],
        much: f64,
        of: impl Fn(&mut Mover) -> &mut Twist,
    ) {
        if let Some(i) = contact.b {
            of(&mut movers[i]).add_scaled(much, &self.push_b);
        }
        if let Some(i) = contact.a {
            of(&mut movers[i]).add_scaled(-much, &self.push_a);
        }
    }
}

fn velocity(mover: &Mover) -> Twist {
    mover.velocity
}

fn velocity_mut(mover: &mut Mover) -> &mut Twist {
    &mut mover.velocity
}

/// Solves the contacts of an island: changes velocities, ways and impulses.
///
/// A body that is pushed goes on from where the step began with the velocity at its end, before it bounces (Moreau's
/// scheme): it comes to lie on what it meets, and stays.
pub(crate) fn solve(movers: &mut [Mover], contacts: &mut [Contact], rules: &Rules) {
    let mut rows: Vec<[Row; 3]> = contacts
        .iter()
        .map(|contact| {
            let (across, along) = contact.normal.any_orthonormal_pair();
            let rows = [contact.normal, across, along].map(|d| Row::new(contact, d, movers));
            with_round_friction(rows)
        })
        .collect();
    for (contact, rows) in contacts.iter().zip(&mut rows) {
        for row in rows {
            row.before = row.speed(contact, movers, velocity);
        }
    }
    for (contact, rows) in contacts.iter().zip(&mut rows) {
        warm_start(contact, rows, movers);
    }
    let approach = rows.iter().map(|rows| -rows[0].before).fold(0.0, f64::max);
    let tolerance = rules.tolerance.max(ROUNDING * approach);
    let sweeps = (WORK / contacts.len().max(1)).clamp(SWEEPS[0], SWEEPS[1]);
    for _ in 0..sweeps {
        let mut change: f64 = 0.0;
        for (contact, rows) in contacts.iter().zip(&mut rows) {
            change = change.max(relax(contact, rows, movers, rules.dt));
        }
        if change < tolerance {
            break;
        }
    }
    let lost = -hold_energy(contacts, &mut rows, movers);
    for (contact, rows) in contacts.iter_mut().zip(&rows) {
        contact.impulse = rows.iter().map(|row| row.direction * row.impulse).sum();
        if rows[0].impulse > 0.0 {
            for mover in [contact.a, contact.b].into_iter().flatten() {
                let mover = &mut movers[mover];
                mover.way = Some(mover.velocity.times(rules.dt));
            }
        }
    }
    mend(contacts, &rows, movers, rules);
    bounce(contacts, &rows, movers, rules, lost);
}

/// Friction rows with one mass for both, that of the direction that yields most: else friction would not oppose the
/// sliding but lean towards the direction that yields less.
fn with_round_friction([normal, mut first, mut second]: [Row; 3]) -> [Row; 3] {
    let (c1, c2) = (first.compliance(&first), second.compliance(&second));
    let mixed = first.compliance(&second);
    let half = 0.5 * (c1 - c2);
    let most = 0.5 * (c1 + c2) + (half * half + mixed * mixed).sqrt();
    let mass = if most > 0.0 { 1.0 / most } else { 0.0 };
    (first.mass, second.mass) = (mass, mass);
    [normal, first, second]
}

fn warm_start(contact: &Contact, rows: &mut [Row; 3], movers: &mut [Mover]) {
    let along = contact.impulse.dot(rows[0].direction).max(0.0);
    rows[0].impulse = along;
    let friction = [1, 2].map(|k| contact.impulse.dot(rows[k].direction));
    let friction = within(friction, contact.friction * along);
    (rows[1].impulse, rows[2].impulse) = (friction[0], friction[1]);
    for row in rows {
        row.push(contact, movers, row.impulse, velocity_mut);
    }
}

/// One pass over a contact; the largest change of a relative speed (m/s).
fn relax(contact: &Contact, rows: &mut [Row; 3], movers: &mut [Mover], dt: f64) -> f64 {
    let [normal, friction @ ..] = rows;
    // A gap may close within the step.
    let closing = contact.gap.max(0.0) / dt;
    let speed = normal.speed(contact, movers, velocity) + closing;
    if speed >= 0.0 && normal.impulse == 0.0 {
        // What does not push does not rub: its friction is zero since its last push.
        return 0.0;
    }
    let impulse = (normal.impulse - OVER * normal.mass * speed).max(0.0);
    let change = impulse - normal.impulse;
    normal.impulse = impulse;
    normal.push(contact, movers, change, velocity_mut);
    let mut largest = if normal.mass > 0.0 {
        (change / normal.mass).abs()
    } else {
        0.0
    };

    let wanted = [0, 1].map(|k| {
        let row = &friction[k];
        row.impulse - row.mass * row.speed(contact, movers, velocity)
    });
    let wanted = within(wanted, contact.friction * impulse);
    for (row, impulse) in friction.iter_mut().zip(wanted) {
        let change = impulse - row.impulse;
        row.impulse = impulse;
        row.push(contact, movers, change, velocity_mut);
        if row.mass > 0.0 {
            largest = largest.max((change / row.mass).abs());
        }
    }
    largest
}

/// A vector, or the nearest to it that is no longer than `length`.
fn within([x, y]: [f64; 2], length: f64) -> [f64; 2] {
    let long = (x * x + y * y).sqrt();
    let factor = if long > length { length / long } else { 1.0 };
    [factor * x, factor * y]
}

/// Takes off what the impulses add to the kinetic energy, if they do; what they add (J), never positive.
fn hold_energy(contacts: &[Contact], rows: &mut [[Row; 3]], movers: &mut [Mover]) -> f64 {
    // Of a share s of all impulses: s first + s^2 second.
    let (mut first, mut second) = (0.0, 0.0);
    for (contact, rows) in contacts.iter().zip(rows.iter()) {
        for row in rows {
            let after = row.speed(contact, movers, velocity);
            first += row.impulse * row.before;
            second += 0.5 * row.impulse * (after - row.before);
        }
    }
    if first + second <= 0.0 {
        return first + second;
    }
    let share = if first < 0.0 { -first / second } else { 0.0 };
    for (contact, rows) in contacts.iter().zip(rows.iter_mut()) {
        for row in rows {
            let less = (share - 1.0) * row.impulse;
            row.push(contact, movers, less, velocity_mut);
            row.impulse += less;
        }
    }
    0.0
}

/// Sends back what met in this step at `restitution` times the speed of approach (Newton's hypothesis), as far as the
/// energy `lost` so far (J) pays for it.
fn bounce(contacts: &[Contact], rows: &[[Row; 3]], movers: &mut [Mover], rules: &Rules, lost: f64) {
    let bouncing: Vec<(&Contact, &Row, f64)> = contacts
        .iter()
        .zip(rows)
        .filter(|(contact, rows)| {
            rows[0].before < -rules.bounce && rows[0].impulse > 0.0 && contact.restitution > 0.0
        })
        .map(|(contact, rows)| (contact, &rows[0], -contact.restitution * rows[0].before))
        .collect();
    let speeds = |movers: &[Mover]| -> Vec<f64> {
        let speed =
            |(contact, row, _): &(&Contact, &Row, f64)| row.speed(contact, movers, velocity);
        bouncing.iter().map(speed).collect()
    };
    let before = speeds(movers);
    let mut extra = vec![0.0; bouncing.len()];
    for _ in 0..BOUNCING_SWEEPS {
        for ((contact, row, wanted), extra) in bouncing.iter().zip(&mut extra) {
            let missing = wanted - row.speed(contact, movers, velocity);
            let more = (row.mass * missing).max(-*extra);
            *extra += more;
            row.push(contact, movers, more, velocity_mut);
        }
    }
    // Of a share s of the extra impulses: s first + s^2 second.
    let (mut first, mut second) = (0.0, 0.0);
    for ((extra, before), after) in extra.iter().zip(&before).zip(&speeds(movers)) {
        first += extra * before;
        second += 0.5 * extra * (after - before);
    }
    if first + second <= lost || second <= 0.0 {
        return;
    }
    let half = 0.5 * first;
    let share = ((half * half + second * lost).sqrt() - half) / second;
    for ((contact, row, _), extra) in bouncing.iter().zip(&extra) {
        row.push(contact, movers, (share - 1.0) * extra, velocity_mut);
    }
}

/// Moves apart what overlaps more at the end of the step than it may.
fn mend(contacts: &[Contact], rows: &[[Row; 3]], movers: &mut [Mover], rules: &Rules) {
    let way = |mover: &Mover| mover.way.unwrap_or_else(|| mover.velocity.times(rules.dt));
    for _ in 0..MENDING_SWEEPS {
        let mut deepest: f64 = 0.0;
        for (contact, rows) in contacts.iter().zip(rows) {
            let part = |mover: Option<usize>, arm: Vector| {
                mover.map_or(Vector::ZERO, |i| way(&movers[i]).displacement(arm))
            };
            let apart = part(contact.b, contact.arm_b) - part(contact.a, contact.arm_a);
            let least = (contact.gap * (1.0 - MENDED)).min(-0.5 * contact.skin);
            let missing = least - contact.gap - apart.dot(contact.normal);
            if missing > 0.0 {
                deepest = deepest.max(missing / contact.skin);
                rows[0].push(contact, movers, rows[0].mass * missing, |mover| {
                    let velocity = mover.velocity;
                    mover.way.get_or_insert_with(|| velocity.times(rules.dt))
                });
            }
        }
        if deepest <= 0.1 {
            break;
        }
    }
}
