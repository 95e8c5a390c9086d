//! Vectors with which the ends of steps are answered.

/// Vectors to compute with.
pub struct Vectors<V, C> {
    still: V,
    q: V,
    v: V,
    rows: C,
}

impl<V: Clone, C> Vectors<V, C> {
    /// Of a zero per coordinate and a zero per constraint.
    pub fn new(still: V, rows: C) -> Self {
        Self { q: still.clone(), v: still.clone(), still, rows }
    }

    /// The vectors as slices.
    pub fn changes<T>(&mut self) -> Changes<'_, T>
    where
        V: AsRef<[T]> + AsMut<[T]>,
        C: AsMut<[T]>,
    {
        let Self { still, q, v, rows } = self;
        Changes { still: (*still).as_ref(), rows: rows.as_mut(), q: q.as_mut(), v: v.as_mut() }
    }
}

/// Vectors to compute with, as slices.
pub struct Changes<'a, T> {
    /// Zeros.
    pub still: &'a [T],
    /// A zero per constraint, at first.
    pub rows: &'a mut [T],
    /// Changes of positions.
    pub q: &'a mut [T],
    /// Changes of velocities.
    pub v: &'a mut [T],
}
