//! Members of a sweep whose numbers end.

use std::sync::atomic::AtomicBool;

use mbs_runtime::Error;
use mbs_workbench::members::{Member, Members};
use mbs_workbench::model::{in_lanes, of};
use mbs_workbench::{Model, Settings};

mbs_runtime::mechanism! {
    /// A slider that is driven as it likes, and a measurement that ends with its time.
    pub Measured {
        dof = 0;
        /// When there is nothing left to measure.
        param until = 1 [s];
        body slider (x) { mass = 1 [kg]; }
        drive motion: x = 1 [m/s]*t;
        /// A number up to then.
        output left = sqrt((until - t)/(1 [s]));
    }
}

/// The results of members that are measured for so many seconds, in a run of half a second.
fn swept(model: &dyn Model, until: &[f64]) -> Result<Vec<Member>, mbs_workbench::Error> {
    let mut taken = Vec::new();
    let members = Members {
        names: vec!["until".to_owned()],
        count: until.len(),
        values: &|at| vec![until[at]],
        take: &mut |_, member| taken.push(member),
        progress: &|_| (),
        cancel: &AtomicBool::new(false),
    };
    let settings = Settings { step: 1e-3, end: 0.5, ..Settings::default() };
    model.sweep(&settings, members)?;
    Ok(taken)
}

/// Regression: the peaks of members whose outputs became NaN were those of the finite part,
/// and their column of errors was empty.
#[test]
fn a_member_whose_output_ends_is_an_error_with_its_name() -> Result<(), mbs_workbench::Error> {
    let until = [2.0, 0.3, 0.7, 0.1, 1.0, 3.0, 0.2, 4.0, 0.4];
    for model in [of::<Measured<f64>>(), in_lanes::<Measured<f64>>(Settings::default())] {
        for (until, member) in until.into_iter().zip(swept(model.as_ref(), &until)?) {
            match member {
                Ok(extents) => {
                    assert!(until > 0.5, "{until}");
                    let left = extents.last().map(|left| left.last);
                    assert_eq!(left, Some(f64::sqrt(until - 0.5)));
                }
                Err(Error::Undefined { t, name, value, .. }) => {
                    assert!(until < 0.5 && (until..until + 2e-3).contains(&t), "{until}: {t}");
                    assert!(name == "left" && value.is_nan());
                }
                Err(other) => panic!("{until}: {other}"),
            }
        }
    }
    Ok(())
}
