//! Methods of integration, asked for by their words.

use mbs_runtime::{COMPOSITIONS, Composition, IMPLICIT, Implicit, SCHEMES, Stabilization, Tableau};

use crate::status::{Failure, Status};

/// A method; what is `None` is as the text declares it.
#[derive(Clone, Copy, Debug)]
pub enum Method {
    /// The stages of a scheme, with what keeps the constraints.
    Explicit(Option<&'static Tableau>, Option<Stabilization>),
    /// RATTLE.
    Rattle(&'static Composition),
    /// An implicit scheme, for stiff forces.
    Implicit(&'static Implicit),
}

impl Method {
    /// The method with these words.
    ///
    /// # Errors
    /// There is none.
    pub fn find(text: &str) -> Result<Self, Failure> {
        match (Composition::find(text.trim()), Implicit::find(text.trim())) {
            (Some(composition), _) => return Ok(Self::Rattle(composition)),
            (_, Some(scheme)) => return Ok(Self::Implicit(scheme)),
            (None, None) => {}
        }
        let (mut scheme, mut stabilization) = (None, None);
        for word in text.split_whitespace() {
            match (Tableau::find(word), Stabilization::find(word)) {
                (Some(found), _) if scheme.is_none() => scheme = Some(found),
                (_, Some(found)) if stabilization.is_none() => stabilization = Some(found),
                _ => return Err(unknown(text)),
            }
        }
        Ok(Self::Explicit(scheme, stabilization))
    }
}

fn unknown(text: &str) -> Failure {
    let schemes = SCHEMES.map(|scheme| scheme.word).join(", ");
    let kept = Stabilization::ALL.map(Stabilization::word).join(", ");
    let alone = COMPOSITIONS.map(|composition| composition.word).into_iter();
    let alone = alone.chain(IMPLICIT.map(|scheme| scheme.word)).collect::<Vec<_>>().join(", ");
    let message = format!(
        "there is no method `{text}`; it is one of {schemes}, or one of {kept}, or one of each with a space between \
         them, or one of {alone}"
    );
    Failure::new(Status::Name, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_any_order() {
        let found = |text| match Method::find(text) {
            Ok(Method::Explicit(scheme, kept)) => {
                [scheme.map_or("", |it| it.word), kept.map_or("", |it| it.word())]
            }
            Ok(Method::Rattle(composition)) => [composition.word, "alone"],
            Ok(Method::Implicit(scheme)) => [scheme.word, "alone"],
            Err(failure) => {
                assert_eq!(failure.status, Status::Name);
                ["", "none"]
            }
        };
        assert_eq!(found(""), ["", ""]);
        assert_eq!(found("rk4"), ["rk4", ""]);
        assert_eq!(found(" projection  dopri5 "), ["dopri5", "projection"]);
        assert_eq!(found("per-stage"), ["", "per-stage"]);
        assert_eq!(found("rattle4"), ["rattle4", "alone"]);
        assert_eq!(found(" trbdf2 "), ["trbdf2", "alone"]);
        assert_eq!(found("esdirk4"), ["esdirk4", "alone"]);
        for wrong in ["rk", "rk4 rk4", "held held", "rk4 heun", "rattle held", "rk4,held", "RK4"] {
            assert_eq!(found(wrong), ["", "none"], "{wrong}");
        }
    }
}
