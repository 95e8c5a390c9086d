//! The functions of the interface, in the order of the header, which says what they do.
//!
//! The header is written by hand, since it is the documentation. `tests/header.rs` reads both and holds them
//! together.

use std::ffi::{CStr, c_char, c_int};

use crate::border::{Exclusive, Numbers, NumbersOut, Out, Owned, Shared, Text};
use crate::last::{self, Problem};
use crate::mechanism::{Choices, Kind, Mechanism, Quantity};
use crate::run::Run;
use crate::status::{Status, words};

/// The binary interface, `MBS_ABI` of the header.
const ABI: u32 = 1;

const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => c"",
};

export_plain! {
    fn mbs_version() -> *const c_char {
        VERSION.as_ptr()
    } else c"".as_ptr();

    fn mbs_abi() -> u32 {
        ABI
    } else 0;

    fn mbs_status_text(status: c_int) -> *const c_char {
        words(status).as_ptr()
    } else c"".as_ptr();

    fn mbs_error() -> *const c_char {
        last::pointer()
    } else c"".as_ptr();

    fn mbs_problem_count() -> usize {
        last::problem_count()
    } else 0;

    // no failure is kept, since that would replace the one that is asked for
    fn mbs_problem_at(index: usize, problem: Out<'_, Problem>) -> c_int {
        let status = match (problem.ready("problem"), last::problem(index)) {
            (Err(_), _) => Status::Null,
            (Ok(_), None) => Status::Index,
            (Ok(mut place), Some(found)) => {
                place.put(found);
                Status::Ok
            }
        };
        status as c_int
    } else Status::Internal as c_int;

    fn mbs_mechanism_free(mechanism: Owned<Mechanism>) -> () {
        mechanism.free();
    } else ();

    fn mbs_run_free(run: Owned<Run>) -> () {
        run.free();
    } else ();
}

// Mechanisms
export! {
    fn mbs_compile(
        text: Text<'_>,
        file: Text<'_>,
        name: Text<'_>,
        limit: f64,
        mechanism: Out<'_, *mut Mechanism>,
    ) {
        mechanism.ready("mechanism")?.put_handle(|| {
            let (text, file) = (text.get("text")?, file.optional("file")?.unwrap_or("text"));
            Mechanism::compiled(text, file, &Choices { name: name.optional("name")?, limit })
        })
    }

    fn mbs_read(path: Text<'_>, name: Text<'_>, limit: f64, mechanism: Out<'_, *mut Mechanism>) {
        mechanism.ready("mechanism")?.put_handle(|| {
            Mechanism::read(path.get("path")?, &Choices { name: name.optional("name")?, limit })
        })
    }

    fn mbs_mechanism_name(mechanism: Shared<'_, Mechanism>, name: Out<'_, *const c_char>) {
        let mechanism = mechanism.get()?;
        name.ready("name")?.put(mechanism.name().as_ptr());
        Ok(())
    }

    fn mbs_mechanism_freedom(mechanism: Shared<'_, Mechanism>, freedom: Out<'_, i32>) {
        let mechanism = mechanism.get()?;
        freedom.ready("freedom")?.put(mechanism.live().declared_info().dof);
        Ok(())
    }

    fn mbs_count(mechanism: Shared<'_, Mechanism>, kind: c_int, count: Out<'_, usize>) {
        let (mechanism, kind) = (mechanism.get()?, Kind::of(kind)?);
        count.ready("count")?.put(mechanism.count(kind));
        Ok(())
    }

    fn mbs_find(mechanism: Shared<'_, Mechanism>, kind: c_int, name: Text<'_>, index: Out<'_, usize>) {
        let (mechanism, kind) = (mechanism.get()?, Kind::of(kind)?);
        let found = mechanism.find(kind, name.get("name")?)?;
        index.ready("index")?.put(found);
        Ok(())
    }

    fn mbs_describe(
        mechanism: Shared<'_, Mechanism>,
        kind: c_int,
        index: usize,
        quantity: Out<'_, Quantity>,
    ) {
        let (mechanism, kind) = (mechanism.get()?, Kind::of(kind)?);
        let found = mechanism.quantity(kind, index)?;
        quantity.ready("quantity")?.put(found);
        Ok(())
    }
}

// Runs: what is set before the start
export! {
    fn mbs_run_new(
        mechanism: Shared<'_, Mechanism>,
        method: Text<'_>,
        step: f64,
        run: Out<'_, *mut Run>,
    ) {
        run.ready("run")?.put_handle(|| {
            Run::new(mechanism.get()?, method.optional("method")?.unwrap_or_default(), step)
        })
    }

    fn mbs_run_clone(run: Shared<'_, Run>, copy: Out<'_, *mut Run>) {
        copy.ready("copy")?.put_handle(|| run.get().cloned())
    }

    fn mbs_run_set_parameter(run: Exclusive<'_, Run>, index: usize, value: f64) {
        run.get()?.set_parameter(index, value)
    }

    fn mbs_run_set_input(run: Exclusive<'_, Run>, index: usize, value: f64) {
        run.get()?.set_input(index, value)
    }

    fn mbs_run_set_start(
        run: Exclusive<'_, Run>,
        time: f64,
        positions: Numbers<'_>,
        velocities: Numbers<'_>,
        count: usize,
    ) {
        let run = run.get()?;
        let expected = run.info().coordinates.len();
        let positions = positions.read("positions", count, expected)?;
        let velocities = velocities.read("velocities", count, expected)?;
        run.set_start(time, positions, velocities);
        Ok(())
    }

    fn mbs_run_set_tolerances(run: Exclusive<'_, Run>, relative: f64, absolute: f64) {
        run.get()?.set_tolerances(relative, absolute)
    }

    fn mbs_run_set_gains(run: Exclusive<'_, Run>, alpha: f64, beta: f64) {
        run.get()?.set_gains(alpha, beta)
    }
}

// Runs: motion
export! {
    fn mbs_run_start(run: Exclusive<'_, Run>) {
        run.get()?.start()
    }

    fn mbs_run_step(run: Exclusive<'_, Run>, steps: u64) {
        Ok(run.get()?.motion_mut()?.advance(steps)?)
    }

    fn mbs_run_advance_to(run: Exclusive<'_, Run>, end: f64) {
        let motion = run.get()?.motion_mut()?;
        let steps = motion.ends_at(end)?;
        Ok(motion.advance(steps)?)
    }
}

// Runs: what can be read
export! {
    fn mbs_run_time(run: Shared<'_, Run>, time: Out<'_, f64>) {
        let now = run.get()?.motion()?.time();
        time.ready("time")?.put(now);
        Ok(())
    }

    fn mbs_run_parameters(run: Shared<'_, Run>, values: NumbersOut<'_>, count: usize) {
        let parameters = run.get()?.parameters();
        values.ready("values", count, parameters.len())?.put(parameters);
        Ok(())
    }

    fn mbs_run_inputs(run: Shared<'_, Run>, values: NumbersOut<'_>, count: usize) {
        let inputs = run.get()?.inputs();
        values.ready("values", count, inputs.len())?.put(inputs);
        Ok(())
    }

    fn mbs_run_state(
        run: Shared<'_, Run>,
        positions: NumbersOut<'_>,
        velocities: NumbersOut<'_>,
        count: usize,
    ) {
        let run = run.get()?;
        let expected = run.info().coordinates.len();
        let positions = positions.ready("positions", count, expected)?;
        let velocities = velocities.ready("velocities", count, expected)?;
        let [q, v] = run.state()?;
        positions.put(&q);
        velocities.put(&v);
        Ok(())
    }

    fn mbs_run_reactions(
        run: Shared<'_, Run>,
        accelerations: NumbersOut<'_>,
        count: usize,
        multipliers: NumbersOut<'_>,
        constraints: usize,
    ) {
        let run = run.get()?;
        let accelerations = accelerations.ready("accelerations", count, run.info().coordinates.len())?;
        let multipliers = multipliers.ready("multipliers", constraints, run.info().constraints.len())?;
        let [solved, reactions] = run.reactions()?;
        accelerations.put(&solved);
        multipliers.put(&reactions);
        Ok(())
    }

    fn mbs_run_outputs(run: Shared<'_, Run>, values: NumbersOut<'_>, count: usize) {
        let run = run.get()?;
        let values = values.ready("values", count, run.info().outputs.len())?;
        values.put(&run.outputs()?);
        Ok(())
    }

    fn mbs_run_points(run: Shared<'_, Run>, places: NumbersOut<'_>, count: usize) {
        let run = run.get()?;
        let places = places.ready("places", count, 2 * run.points())?;
        places.put(&run.places()?);
        Ok(())
    }

    fn mbs_run_energy(run: Shared<'_, Run>, kinetic: Out<'_, f64>, potential: Out<'_, f64>) {
        let (mut kinetic, mut potential) = (kinetic.ready("kinetic")?, potential.ready("potential")?);
        let [of_motion, of_place] = run.get()?.energies()?;
        kinetic.put(of_motion);
        potential.put(of_place);
        Ok(())
    }

    fn mbs_run_violation(run: Shared<'_, Run>, violation: Out<'_, f64>, rate: Out<'_, f64>) {
        let (mut violation, mut rate) = (violation.ready("violation")?, rate.ready("rate")?);
        let [of_positions, of_velocities] = run.get()?.motion()?.violations();
        violation.put(of_positions);
        rate.put(of_velocities);
        Ok(())
    }

    fn mbs_run_digits(run: Shared<'_, Run>, digits: Out<'_, f64>) {
        let left = run.get()?.motion()?.digits_left();
        digits.ready("digits")?.put(left);
        Ok(())
    }
}
