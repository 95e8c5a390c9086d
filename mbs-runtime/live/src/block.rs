//! Members of one mechanism that take their steps together.
#![allow(clippy::needless_range_loop, reason = "lanes are counted through several vectors")]

use mbs_runtime::__private::Spline;
use mbs_runtime::equations::At;
use mbs_runtime::{Gains, Lanes};

use crate::Live;
use crate::arguments::Arguments;
use crate::heun::Heun;
use crate::instruction::{Instruction, execute};

/// Members of a block.
pub const LANES: usize = 32;

/// Numbers in a vector instruction of the widest kind.
const WIDTH: usize = 8;
const VECTORS: usize = LANES / WIDTH;

type Vector = Lanes<f64, WIDTH>;

/// A number of each member.
type Column = [Vector; VECTORS];

/// A member of a [`Block`]: a live mechanism in its last good state.
#[derive(Clone, Copy, Debug)]
pub struct Member<'a> {
    /// The mechanism, with its own parameters.
    pub mechanism: &'a Live,
    /// Time, positions and velocities.
    pub at: At<'a, f64>,
    /// The inputs.
    pub inputs: &'a [f64],
    /// The gains of the feedback.
    pub gains: Gains<f64>,
    /// The step in s.
    pub step: f64,
}

/// Up to [`LANES`] members of one mechanism, which take their steps of Heun's method
/// together: an instruction is decoded once for all of them, and done in vectors.
///
/// A member comes out as its [`Stepper`](crate::Stepper) alone does, to the last bit. What
/// the vectors cannot compute is a sine or cosine beyond 10⁵ rad: there a step is not
/// finite, and the member has to take it alone.
///
/// # Example
/// ```
/// use mbs_live::{Block, Member, Text};
/// use mbs_runtime::equations::At;
/// use mbs_runtime::{Gains, growth_limit};
///
/// let text = "Oscillator {
///     dof = 1;
///     param k = 4 [N/m] where k > 0;
///     body mass (x) { mass = 1 [kg]; }
///     force spring on x = -k*x;
///     start { x = 1 [m]; }
/// }";
/// let soft = Text::declaration("oscillator.mbs", text).compile()?;
/// let stiff = soft.with_parameters(|values| values[0] = 9.0)?;
/// let h = 1e-3;
/// let gains = Gains { minus_two_alpha: 0.0, minus_beta_squared: 0.0 };
/// let at = At { t: 0.0, q: &[1.0], v: &[0.0] };
/// let member = |mechanism| Member { mechanism, at, inputs: &[], gains, step: h };
/// let mut block = Block::new(true, &[member(&soft), member(&stiff)]).ok_or("two of a kind")?;
/// for _ in 0..1000 {
///     assert!(block.step(&[growth_limit(); 32])[..2] == [true; 2]);
/// }
/// assert!((block.position(0, 0) - 2.0_f64.cos()).abs() < 1e-5);
/// assert!((block.position(0, 1) - 3.0_f64.cos()).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Block {
    heun: Heun<Vector, VECTORS>,
    q: Vec<Column>,
    v: Vec<Column>,
    inputs: Vec<Column>,
    gains: [Column; 2],
    step: Column,
    /// The time of the start, and steps since then.
    start: Column,
    steps: Column,
}

impl Block {
    /// These members, each from where it is, with feedback that is held over each step or
    /// computed in both of its stages. Lanes that are left over do what the first one does.
    ///
    /// Nothing if there is none, if there are more than [`LANES`], or if they do not share
    /// their [programs](Live::shares_programs_with).
    pub fn new(is_held: bool, members: &[Member<'_>]) -> Option<Self> {
        let first = members.first()?;
        let are_alike = members.iter().all(|it| it.mechanism.shares_programs_with(first.mechanism));
        if !are_alike || members.len() > LANES {
            return None;
        }
        let of = |lane: usize| members.get(lane).unwrap_or(first);
        let each = |number: &dyn Fn(&Member<'_>) -> f64| column(|lane| number(of(lane)));
        let component = |vector: &[f64], at: usize| vector.get(at).copied().unwrap_or(f64::NAN);
        let info = first.mechanism.declared_info();
        let programs = first.mechanism.programs();
        Some(Self {
            heun: Heun::new(programs, is_held, run, |fixed| each(&|it| it.mechanism.fixed(fixed))),
            q: (0..info.coordinates.len()).map(|at| each(&|it| component(it.at.q, at))).collect(),
            v: (0..info.coordinates.len()).map(|at| each(&|it| component(it.at.v, at))).collect(),
            inputs: (0..info.inputs.len()).map(|at| each(&|it| component(it.inputs, at))).collect(),
            gains: [each(&|it| it.gains.minus_two_alpha), each(&|it| it.gains.minus_beta_squared)],
            step: each(&|it| it.step),
            start: each(&|it| it.at.t),
            steps: column(|_| 0.0),
        })
    }

    /// A step of every member, and which of them took it: a member stays where it is if its
    /// growth would be over its limit, or its state not finite.
    pub fn step(&mut self, limits: &[f64; LANES]) -> [bool; LANES] {
        let Self { heun, q, v, inputs, gains, step, start, steps } = self;
        let after = |count: Column| zip(*start, zip(count, *step, |n, h| n * h), |t, span| t + span);
        let next = steps.map(|count| count + Lanes([1.0; WIDTH]));
        let (t, t_next) = (after(*steps), after(next));
        heun.step(&Arguments { t, q, v, inputs, gains: *gains, step: *step, t_next, ..Arguments::default() });

        // 0 of what is finite
        let trouble = |sum: Column, x: &Column| zip(sum, zip(*x, *x, |a, b| a - b), |sum, x| sum + x);
        let trouble = heun.q.iter().chain(&heun.v).fold(column(|_| 0.0), trouble);
        let mut is_taken = [false; LANES];
        for lane in 0..LANES {
            is_taken[lane] = read(&heun.growth, lane) <= limits[lane] && read(&trouble, lane) == 0.0;
        }
        if is_taken == [true; LANES] {
            std::mem::swap(q, &mut heun.q);
            std::mem::swap(v, &mut heun.v);
            *steps = next;
        } else {
            let states = q.iter_mut().zip(&heun.q).chain(v.iter_mut().zip(&heun.v));
            for (column, next) in states.chain([(steps, &next)]) {
                for lane in (0..LANES).filter(|&lane| is_taken[lane]) {
                    write(column, lane, read(next, lane));
                }
            }
        }
        is_taken
    }

    /// The pivot growth of the last step of a member, taken or not. What this and the
    /// functions below say of a lane or a coordinate that does not exist is no number.
    pub fn growth(&self, lane: usize) -> f64 {
        read(&self.heun.growth, lane)
    }

    /// The time of a member in s.
    pub fn time(&self, lane: usize) -> f64 {
        read(&self.start, lane) + read(&self.steps, lane) * read(&self.step, lane)
    }

    /// A coordinate of a member.
    pub fn position(&self, coordinate: usize, lane: usize) -> f64 {
        self.q.get(coordinate).map_or(f64::NAN, |column| read(column, lane))
    }

    /// Its velocity.
    pub fn velocity(&self, coordinate: usize, lane: usize) -> f64 {
        self.v.get(coordinate).map_or(f64::NAN, |column| read(column, lane))
    }

    /// Takes a member a step ahead to positions and velocities that were computed elsewhere.
    pub fn put(&mut self, lane: usize, q: &[f64], v: &[f64]) {
        for (column, &number) in self.q.iter_mut().zip(q).chain(self.v.iter_mut().zip(v)) {
            write(column, lane, number);
        }
        let next = read(&self.steps, lane) + 1.0;
        write(&mut self.steps, lane, next);
    }

    /// Sets an input of a member for the steps to come.
    pub fn set_input(&mut self, input: usize, lane: usize, value: f64) {
        if let Some(column) = self.inputs.get_mut(input) {
            write(column, lane, value);
        }
    }
}

fn column(number: impl Fn(usize) -> f64) -> Column {
    std::array::from_fn(|vector| Lanes(std::array::from_fn(|at| number(vector * WIDTH + at))))
}

fn zip(a: Column, b: Column, f: impl Fn(Vector, Vector) -> Vector) -> Column {
    std::array::from_fn(|at| f(a[at], b[at]))
}

fn read(column: &Column, lane: usize) -> f64 {
    column.get(lane / WIDTH).map_or(f64::NAN, |vector| vector.0[lane % WIDTH])
}

fn write(column: &mut Column, lane: usize, number: f64) {
    if let Some(vector) = column.get_mut(lane / WIDTH) {
        vector.0[lane % WIDTH] = number;
    }
}

/// The instructions in the widest vectors that the processor has; AVX-512 without fused
/// operations, which nobody writes here: results do not depend on the target.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2+fma+avx512f+avx512dq+avx512vl+avx512bw+avx512cd",
    "x86_64+avx+avx2+fma",
))]
fn run(instructions: &[Instruction], splines: &[Spline], values: &mut [Column]) {
    execute(instructions, splines, values);
}
