//! What the paper states, with the place, and the measurement of a coin; what the precomputation is validated against is
//! in `references.rs`. No other number of the report is quoted.

/// The paper.
pub(crate) const TITLE: &str = "H. Xie and K. Miyata, <i>Langevin Rigid: Animating Immersed Rigid \
    Bodies in Real-time</i>, The Journal of the Society for Art and Science 13(1), 2014, section 7";

/// Reynolds number of Fig. 2 (caption).
pub(crate) const FIG2_REYNOLDS: f64 = 3.8e3;
/// Grid of Fig. 2 (caption).
pub(crate) const FIG2_CELLS: [usize; 3] = [32, 32, 16];
/// Grid of the precomputation time (section 7).
pub(crate) const TIMED_CELLS: [usize; 3] = [32, 32, 8];
/// Reynolds number of the sheet (section 7).
pub(crate) const SHEET_REYNOLDS: f64 = 4.3e4;
/// Precomputation of added mass for 1280 triangles, s (section 7).
pub const ADDED_MASS_SECONDS: f64 = 53e-3;
/// Precomputation of the turbulence on 32 x 32 x 8 cells, s (section 7).
pub const TURBULENCE_SECONDS: f64 = 182e-3;
/// "not more than", for a step (section 7), s.
pub(crate) const STEP_LIMIT_SECONDS: f64 = 2e-3;
/// The machine of the paper's times (section 7).
pub(crate) const MACHINE: &str = "Intel Core i7, 3.20 GHz, 12 GB";
/// Table 2: our scene, the paper's body, its triangles, its time step (s), its cost of a step (s).
pub const TABLE_2: [(&str, &str, u32, f64, f64); 6] = [
    (
        "table2-ellipsoid-320-1ms",
        "ellipsoid 1",
        320,
        1e-3,
        1.59e-3,
    ),
    (
        "table2-ellipsoid-320-5ms",
        "ellipsoid 1",
        320,
        5e-3,
        1.63e-3,
    ),
    (
        "table2-ellipsoid-320-10ms",
        "ellipsoid 1",
        320,
        10e-3,
        1.65e-3,
    ),
    (
        "table2-ellipsoid-1280-5ms",
        "ellipsoid 2",
        1280,
        5e-3,
        1.71e-3,
    ),
    ("table2-paper-5ms", "piece of paper", 1024, 5e-3, 1.73e-3),
    ("table2-airplane-5ms", "paper airplane", 288, 5e-3, 1.86e-3),
];

/// What is said of Fig. 2 (section 5).
pub(crate) const FIG2_WORDS: &str = "Figure 2 shows the varying dissipate rate accompanying the \
    kinetic energy in the calculated result.";
/// What is said of Fig. 3 (section 7).
pub(crate) const FIG3_WORDS: &str = "The paper falls down following a helical trajectory in Figure \
    3(a) and a side-to-side tumbling motion in Figure 3(b) [...]. The trajectories have the secondary \
    motions that the paper rotates around the major-axis while falling";
/// What is said of Fig. 4 (section 7).
pub(crate) const FIG4_WORDS: &str = "The simulation begins with an initial velocity of 20 cm/s in \
    the horizontal direction, and the simulated result shows two turning motions (turning front and \
    turning sideways)";
/// What is said of Fig. 5 (section 7).
pub(crate) const FIG5_WORDS: &str = "A small scale of fluttering motion can be found in Figure 5(a) \
    using the simulation method of the previous work [21]. [...] The oscillations of rigid body in \
    differential directions from falling experiments (Figure 5(c)) are captured in our simulation";
/// What is said of fluttering and tumbling (section 8).
pub(crate) const LIMITS_WORDS: &str = "Some characteristic motions like fluttering and tumbling \
    motions, are not apparently captured by the approximated turbulent model.";

/// 18 drops of a 10 CZK coin, tracked in stereo by O. Novotny (autumn-coin, MIT licence).
pub(crate) mod coin {
    /// Where the measurement is from.
    pub(crate) const SOURCE: &str = "18 drops of a 10 CZK coin (7.62 g, 24.5 mm) in a tank of 38 x 32 \
        x 38 cm, tracked in stereo (O. Novotny, autumn-coin, MIT licence)";
    /// Time (s), mean depth, standard deviation of the depth, standard deviation of x (m).
    pub(crate) const SINKING: [[f64; 4]; 3] = [
        [0.2, 0.073, 0.011, 0.0097],
        [0.4, 0.167, 0.013, 0.0174],
        [0.6, 0.282, 0.040, 0.0566],
    ];
    /// Standard deviation of the landing points along x and z (m).
    pub(crate) const LANDING: [f64; 2] = [0.113, 0.084];
    /// Median horizontal distance of the landing points (m).
    pub(crate) const DISTANCE: f64 = 0.151;
}
