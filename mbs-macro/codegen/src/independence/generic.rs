//! The rank of Φ_q whatever the dimensions and the position, in exact arithmetic.
//!
//! Symbols are random numbers of a finite field, and angles are random turns, so that
//! sin² + cos² = 1 and sums and fractions of angles are what they are. A float constant and a
//! function such as √ or exp stands for itself. A row that depends on others with such stand-ins free
//! depends on them with their true values: a verdict "redundant" is always right, but for a
//! chance below 1e-12. A verdict "independent" may miss a relation between stand-ins; where
//! there are any, floating-point samples are asked as well.

use mbs_symbolic::{Arena, Point, Residue};

use super::exact::dependent_rows;
use super::rows::Dependent;
use super::sparse::SparseRow;
use crate::derive::Equations;

/// The verdict of exact arithmetic about the rows.
pub struct Verdict {
    pub dependent: Vec<Dependent>,
    /// True if nothing was replaced by a stand-in.
    pub is_exact: bool,
}

/// The rows of Φ_q that depend on earlier ones; `None` where an entry has no value.
pub fn judge(arena: &Arena, equations: &Equations) -> Option<Verdict> {
    let mut point = Point::default();
    let mut is_exact = true;
    let mut rows = Vec::with_capacity(equations.phi_q.len());
    for row in &equations.phi_q {
        let mut entries: SparseRow<Residue> = Vec::with_capacity(row.len());
        for (&column, &entry) in row {
            let value = point.value(arena, entry);
            is_exact &= value.is_whole;
            entries.push((column, value.residue?));
        }
        rows.push(entries);
    }
    Some(Verdict { dependent: dependent_rows(rows), is_exact })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::judge;
    use crate::derive::{Equations, derive};
    use crate::independence::Samples;
    use crate::inputs::Inputs;
    use crate::model::Model;

    fn equations(declaration: &str) -> (Model, Inputs, Equations) {
        let tokens = declaration.parse().expect("tokens");
        let declaration = crate::syntax::parse(tokens).expect("the right shape");
        let mut model = crate::model::resolve(&declaration).expect("resolvable");
        let inputs = Inputs::new(&mut model);
        let equations = derive(&mut model, &inputs);
        (model, inputs, equations)
    }

    fn mechanism(constraints: &str) -> (Model, Inputs, Equations) {
        equations(&format!(
            "Test {{ dof = 0; param l = 1 [m]; param e = 0.3 [m];
                body a (x1, y1, p) {{ mass = 1 [kg]; inertia = 1 [kg*m^2]; }}
                body b (x2, y2, q) {{ mass = 1 [kg]; inertia = 1 [kg*m^2]; }}
                {constraints} }}"
        ))
    }

    fn dependent(constraints: &str) -> (Vec<(usize, Vec<usize>)>, bool) {
        let (model, _, equations) = mechanism(constraints);
        let verdict = judge(&model.arena, &equations).expect("no zero was hit");
        (verdict.dependent, verdict.is_exact)
    }

    #[test]
    fn angles_add_up() {
        let half = "constraint r: l*sin(p) = x1; constraint s: 2*l*sin(p/2)*cos(p/2) = x1;";
        assert_eq!(dependent(half), (vec![(1, vec![0])], true));
        let sum = "constraint r: l*cos(p + q) = x1;
                   constraint s: l*cos(p)*cos(q) - l*sin(p)*sin(q) = x1;";
        assert_eq!(dependent(sum), (vec![(1, vec![0])], true));
        let quarter = "constraint r: l*cos(p) = x1; constraint s: l*sin(p + 90 [deg]) = x1;";
        assert_eq!(dependent(quarter), (vec![(1, vec![0])], true));
        let tenth = "constraint r: l*cos(p - 20.1 [deg]) = x1; constraint s: l*sin(p + 69.9 [deg]) = x1;";
        assert_eq!(dependent(tenth), (vec![(1, vec![0])], true));
        let other = "constraint r: l*cos(p) = x1; constraint s: l*sin(p + 80 [deg]) = x1;";
        assert_eq!(dependent(other), (vec![], true));
        let radian = "constraint r: l*cos(p) = x1; constraint s: l*sin(p + 1) = x1;";
        assert_eq!(dependent(radian), (vec![], false));
    }

    #[test]
    fn stand_ins_miss_relations_but_invent_none() {
        let roots = "constraint r: sqrt(x1^2 + y1^2) = l; constraint s: x1^2 + y1^2 = l^2;";
        assert_eq!(dependent(roots), (vec![(1, vec![0])], false));
        let powers = "constraint r: l*exp(p)*exp(q) = x1; constraint s: l*exp(p + q) = x1;";
        assert_eq!(dependent(powers).0, []);
    }

    #[test]
    fn dimensions_are_arbitrary() {
        // At e = l the rows would be one.
        let rows = "constraint r: l*p = x1; constraint s: e*p = x1;";
        assert_eq!(dependent(rows), (vec![], true));
    }

    /// One row of a random linkage: a joint, or one that others imply.
    fn row(kind: u8, at: usize, c: i8) -> String {
        match kind {
            0 => format!("constraint c{at}: x1 + {c}*l*cos(p) = x2 + l*cos(q + p);"),
            1 => format!("constraint c{at}: y1 + {c}*l*sin(p) = y2 + l*sin(q + p);"),
            2 => format!("constraint c{at}: (x1 - x2)^2 + (y1 - y2)^2 = {c}*{c}*l^2 + 2*l^2;"),
            3 => format!("constraint c{at}: {c}*x1 - 2*y1 + {c}*l*sin(p)^2 = l;"),
            4 => format!(
                "constraint c{at}: x1 + y1 + {c}*l*(cos(p) + sin(p)) = x2 + y2 + l*cos(q + p) + l*sin(p + q);"
            ),
            _ => format!("constraint c{at}: {c}*l*p + l*q + x1 = l;"),
        }
    }

    /// True if exact arithmetic finds one relation between these rows, in which all of them take part.
    fn is_circuit(rows: &[String]) -> bool {
        let without = |at: usize| -> String {
            rows.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, row)| row.as_str()).collect()
        };
        dependent(&rows.concat()).0.len() == 1
            && (0..rows.len()).all(|at| dependent(&without(at)).0.is_empty())
    }

    proptest! {
        /// As many rows are dependent in exact arithmetic as in floating point, for rows that often imply each
        /// other. Which of them are said to be depends on what each says of its own, but those that are named with
        /// one do imply it.
        #[test]
        fn exact_and_sampled_ranks_agree(rows in prop::collection::vec((0_u8..6, 1_i8..3), 1..7)) {
            let rows: Vec<String> = rows.iter().enumerate().map(|(at, &(kind, c))| row(kind, at, c)).collect();
            let (model, inputs, equations) = mechanism(&rows.concat());
            let verdict = judge(&model.arena, &equations).expect("no zero was hit");
            prop_assert!(verdict.is_exact);
            let samples = Samples::new(&model, &inputs);
            let sampled = samples.positions().map(|at| samples.echelon(&model, &equations, at));
            let sampled = sampled.max_by_key(|echelon| echelon.rank()).expect("some position");
            prop_assert_eq!(verdict.dependent.len(), sampled.dependent.len(), "{}", rows.concat());
            for (at, others) in verdict.dependent.iter().chain(&sampled.dependent) {
                let circuit: Vec<String> = [at].into_iter().chain(others).map(|at| rows[*at].clone()).collect();
                prop_assert!(is_circuit(&circuit), "{}", circuit.concat());
            }
        }
    }
}
