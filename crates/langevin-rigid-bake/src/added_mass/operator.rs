//! What the solver needs of W: its products, its small blocks, and itself on a subspace.

/// One value per motion.
pub(super) type Six = [f64; 6];

/// Entries of a sparse row or column.
pub(super) type SparseRow = Vec<(u32, f64)>;

/// The symmetric operator W, however it is kept.
pub(super) trait Operator: Sync {
    /// W x for six vectors at once.
    fn product(&self, x: &[Six]) -> Vec<Six>;

    fn diagonal(&self) -> Vec<f64>;

    /// The entries between `rows`, row by row.
    fn block(&self, rows: &[usize]) -> Vec<f64>;

    /// All entries of T^t W T for a few columns.
    fn galerkin(&self, members: &[SparseRow]) -> Vec<f64>;

    /// The most columns that [`galerkin`](Self::galerkin) is cheap for.
    fn most_coarse(&self) -> usize;
}
