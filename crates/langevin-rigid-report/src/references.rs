//! What the validation compares with, and where that is from. Lamb's ellipsoids are closed forms of the run time.
//!
//! Added mass is per density of the fluid, m^3 and m^5, about the middle of the body.

/// A cube with sides of 1 m, in translation and rotation, extrapolated from meshes graded towards the edges. The textbook
/// value, 0.67 to 0.68, is too high.
pub(crate) const CUBE: [f64; 2] = [0.638423, 0.03926];

/// Square plates with sides of 1 m: thickness (m), broadside, end over end; extrapolated as [`CUBE`] is.
pub(crate) const PLATES: [[f64; 3]; 2] =
    [[0.01, 0.46982, 0.020943], [1.0 / 800.0, 0.45772, 0.020254]];

/// Square prisms with sides of 1 m: length (m), motion along it over the volume; no source is on record.
pub(crate) const PRISMS: [[f64; 2]; 3] = [[2.0, 0.33442], [4.0, 0.17302], [10.0, 0.07103]];

/// Discs of paper let go in still air.
pub(crate) mod papers {
    /// Where the measurement is from.
    pub(crate) const SOURCE: &str = "Discs of 70 g/m^2 paper let go flat or on edge (Howison, Hughes &amp; Iida, \
        <i>Nature Machine Intelligence</i> 2020; 15 to 28 drops of each kind)";
    /// Weight of the paper (kg/m^2) and its thickness (m).
    pub(crate) const WEIGHT: f64 = 0.07;
    pub(crate) const THICKNESS: f64 = 6.94e-5;
    /// Height of the release, and height at which a drop is counted as landed (m).
    pub(crate) const HEIGHT: f64 = 1.09;
    pub(crate) const LANDED: f64 = 0.05;
    /// The speed is that over the last part of the way, m.
    pub(crate) const LAST: f64 = 0.55;
    /// Middle of the range of radii (m), whether on edge; mean time (s), mean speed (m/s), median distance (m).
    pub(crate) const DROPS: [(f64, bool, [f64; 3]); 8] = [
        (0.019, false, [1.224, 0.726, 0.358]),
        (0.026, false, [1.255, 0.744, 0.381]),
        (0.035, false, [1.250, 0.756, 0.273]),
        (0.045, false, [1.286, 0.763, 0.267]),
        (0.019, true, [1.439, 0.710, 0.640]),
        (0.026, true, [1.505, 0.672, 0.725]),
        (0.035, true, [1.454, 0.677, 0.715]),
        (0.045, true, [1.138, 0.672, 0.221]),
    ];
}

/// Strips and plates in two dimensions.
pub(crate) mod strips {
    /// Heavy strips that tumble: tip speed over flight speed, and angle of the glide (degrees) (Smith 1971).
    pub(crate) const TIP_SPEED: f64 = 1.1;
    pub(crate) const GLIDE: f64 = 36.0;
    /// I* at which strips go over from flutter to tumbling, Fr 0.67 (Belmonte, Eisenberg & Moses 1998).
    pub(crate) const ONSET: f64 = 0.45;
    /// A plate that autorotates on a fixed axis: tip speed over the wind's for thickness over chord (Iversen 1979).
    pub(crate) fn autorotation(thickness: f64) -> f64 {
        let log = -libm::log(thickness);
        0.329 * log - 0.0246 * log * log
    }
    /// A plate with its mass moved forward, in water: shift over chord; horizontal speed and speed of fall (cm/s) where it
    /// glides; what it does (Li, Goodwill, Wang & Ristroph 2022).
    pub(crate) const SHIFTED: [(f64, Option<[f64; 2]>, &str); 4] = [
        (0.0, None, "flutters"),
        (0.157, Some([29.9, 13.0]), "swings along its glide"),
        (0.236, Some([37.0, 11.25]), "glides"),
        (0.315, None, "dives"),
    ];
}
