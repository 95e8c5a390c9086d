//! Named values.

/// A recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, such as `x1`, `der(x1)` or `lambda(guide)`.
    pub name: String,
    /// Its unit, such as `m` or `N*m`; empty for a bare number.
    pub unit: String,
    /// One value per recorded instant, in that unit.
    pub values: Vec<f64>,
}

impl Column {
    /// An empty column.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), values: Vec::new() }
    }

    /// [`heading`] of it.
    pub fn heading(&self) -> String {
        heading(&self.name, &self.unit)
    }
}

/// The heading of a column: `name [unit]`, or the name alone where there is no unit.
pub fn heading(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
}

#[cfg(test)]
mod tests {
    use super::heading;

    #[test]
    fn headings_with_and_without_a_unit() {
        assert_eq!((heading("mu", ""), heading("l1", "mm")), ("mu".into(), "l1 [mm]".into()));
    }
}
