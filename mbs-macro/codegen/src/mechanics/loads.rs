//! Forces, by the virtual work that they do.

use mbs_symbolic::{Algebra, Expr, Scalar};

use super::Motion;

/// A generalized force along a coordinate.
pub struct Load {
    pub coordinate: usize,
    pub value: Expr,
}

/// A force F that does the virtual work F δs, with ∂s/∂q where that is not 0.
#[derive(Clone)]
pub struct Work {
    pub force: Expr,
    pub along: Vec<(usize, Expr)>,
}

/// A force on a mechanism.
pub struct Applied {
    pub work: Work,
    /// F ∂s/∂q along every coordinate; `None` if F depends on reactions, which are to be
    /// found first.
    pub loads: Option<Vec<Load>>,
}

impl Work {
    /// The work of a force F that moves its place along s.
    pub fn along(motion: &Motion, force: Scalar<'_>, s: Scalar<'_>) -> Self {
        Self { along: motion.slopes(s), force: force.expr() }
    }

    /// F, where it acts.
    pub fn applied<'a>(self, algebra: &'a Algebra<'a>, motion: &Motion) -> Applied {
        let force = algebra.scalar(self.force);
        let load = |&(coordinate, slope): &(usize, Expr)| {
            let value = force * algebra.scalar(slope);
            Load { coordinate, value: value.expr() }
        };
        let is_known = !motion.depends_on_reactions(force);
        Applied { loads: is_known.then(|| self.along.iter().map(load).collect()), work: self }
    }

    /// F ṡ
    pub fn power<'a>(&self, algebra: &'a Algebra<'a>, motion: &Motion) -> Scalar<'a> {
        let rate = |&(coordinate, slope): &(usize, Expr)| {
            algebra.scalar(slope) * motion.velocity(algebra, coordinate)
        };
        let rate = algebra.sum(self.along.iter().map(rate));
        algebra.scalar(self.force) * rate
    }
}
