//! The chains that are compared, each ready to run from its start.

use std::hint::black_box;

use mbs_runtime::{Baumgarte, Components, Held, Mechanism, Simulation, mechanism};
use tests::pendulum::{Links, Pendulum};

/// Small enough for the longest pendulum, whose fastest motion grows with √N.
pub const H: f64 = 1e-4;

tests::pendulum!(mechanism; Pendulum10 10);
tests::pendulum!(mechanism; Pendulum20 20);
tests::pendulum!(mechanism; Pendulum40 40);
tests::pendulum!(mechanism; Pendulum100 100);
tests::pendulum!(mechanism; Pendulum200 200);
tests::pendulum!(mechanism; Pendulum400 400);
tests::pendulum!(mechanism; PendulumStraight40 40 limit unrolled = 1_000_000;);
tests::four_bar!(mechanism; FourBar10 10);
tests::four_bar!(mechanism; FourBar20 20);
tests::four_bar!(mechanism; FourBar40 40);
tests::four_bar!(mechanism; FourBar100 100);
tests::four_bar!(mechanism; FourBar200 200);
tests::four_bar!(mechanism; FourBar400 400);
tests::four_bar!(mechanism; FourBarStraight40 40 limit unrolled = 1_000_000;);

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Chain {
    Pendulum,
    FourBar,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// As generated: repeated parts as loops, if it is long enough.
    Generated,
    /// Generated without loops.
    Straight,
    ByHand,
}

pub struct Kernel {
    pub chain: Chain,
    /// Links, or four-bars.
    pub n: usize,
    pub code: Code,
    /// Runs so many steps from the start; gives the first angle at their end.
    pub run: Box<dyn Fn(u32) -> f64>,
}

impl Kernel {
    pub fn name(&self) -> String {
        let chain = match self.chain {
            Chain::Pendulum => "pendulum",
            Chain::FourBar => "four-bar",
        };
        let code = match self.code {
            Code::Generated => "generated",
            Code::Straight => "straight lines",
            Code::ByHand => "by hand",
        };
        format!("{chain} {}, {code}", self.n)
    }

    /// Every chain in every form that there is of it.
    pub fn all() -> Result<Vec<Self>, mbs_runtime::Error> {
        use Chain::{FourBar, Pendulum};
        use Code::{Generated, Straight};
        Ok(vec![
            generated::<Pendulum10>(Pendulum, 10, Generated)?,
            generated::<Pendulum20>(Pendulum, 20, Generated)?,
            generated::<Pendulum40>(Pendulum, 40, Generated)?,
            generated::<Pendulum100>(Pendulum, 100, Generated)?,
            generated::<Pendulum200>(Pendulum, 200, Generated)?,
            generated::<Pendulum400>(Pendulum, 400, Generated)?,
            generated::<PendulumStraight40>(Pendulum, 40, Straight)?,
            by_hand::<Pendulum10, 10>()?,
            by_hand::<Pendulum40, 40>()?,
            by_hand::<Pendulum400, 400>()?,
            generated::<FourBar10>(FourBar, 10, Generated)?,
            generated::<FourBar20>(FourBar, 20, Generated)?,
            generated::<FourBar40>(FourBar, 40, Generated)?,
            generated::<FourBar100>(FourBar, 100, Generated)?,
            generated::<FourBar200>(FourBar, 200, Generated)?,
            generated::<FourBar400>(FourBar, 400, Generated)?,
            generated::<FourBarStraight40>(FourBar, 40, Straight)?,
        ])
    }
}

/// A run after its first step, which is examined and takes as long as some steps.
fn started<M: Mechanism<Real = f64>>() -> Result<Simulation<M>, mbs_runtime::Error> {
    let mut simulation = Simulation::new(M::new(M::Parameters::default())?, H)?;
    simulation.step()?;
    Ok(simulation)
}

fn generated<M: Mechanism<Real = f64>>(
    chain: Chain,
    n: usize,
    code: Code,
) -> Result<Kernel, mbs_runtime::Error> {
    let start = started::<M>()?;
    let run = move |steps| {
        let mut simulation = black_box(start);
        for _ in 0..steps {
            if simulation.step().is_err() {
                return f64::NAN;
            }
        }
        simulation.state().q.get("theta_1").unwrap_or(f64::NAN)
    };
    Ok(Kernel { chain, n, code, run: Box::new(run) })
}

/// From the start of the generated one.
fn by_hand<M: Mechanism<Real = f64>, const N: usize>() -> Result<Kernel, mbs_runtime::Error> {
    let start = started::<M>()?.state();
    let links = |vector: M::Coordinates| Links::<N>::from_coordinates(vector.into_array().as_ref());
    let start = (links(start.q), links(start.v));
    let best = Baumgarte::<Held>::deadbeat(H);
    let pendulum = Pendulum::new(1.0, 1.0, best.alpha(), best.beta());
    let run = move |steps| {
        let (pendulum, (mut q, mut v)) = black_box((pendulum, start));
        for _ in 0..steps {
            pendulum.step(&mut q, &mut v, H);
        }
        q.theta[0]
    };
    Ok(Kernel { chain: Chain::Pendulum, n: N, code: Code::ByHand, run: Box::new(run) })
}
