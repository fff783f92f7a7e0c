//! Trajectories as tables.

use std::fmt::Write;

use langevin_rigid::State;

/// The columns of a trajectory table: world frame; metres, seconds, radians.
pub const CSV_HEADER: &str = "body,t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";

/// The rows of one body's states, in order, under [`CSV_HEADER`].
///
/// Numbers are written with as many digits as it takes to read back the same bits.
///
/// ```
/// use langevin_rigid::State;
/// let csv = langevin_rigid_formats::trajectory::csv(0, &[State::default()]);
/// assert_eq!(csv.lines().nth(1), Some("0,0,0,0,0,0,0,0,1,0,0,0,0,0,0"));
/// ```
pub fn csv(body: u32, states: &[State]) -> String {
    let mut table = String::with_capacity(64 + 220 * states.len());
    table.push_str(CSV_HEADER);
    table.push('\n');
    for state in states {
        let (v, w) = (state.world_velocity(), state.world_angular_velocity());
        // Writing to a string cannot fail.
        let _ = write!(table, "{body},{}", state.time);
        for x in state
            .position
            .iter()
            .chain(&state.orientation)
            .chain(&v)
            .chain(&w)
        {
            let _ = write!(table, ",{x}");
        }
        table.push('\n');
    }
    table
}
