//! Functions that programs call: those of the host, and small ones of the module.

use mbs_interface::sine::{COSINE, HALF_PI, RANGE, SHIFT, SINE};
use wasm_encoder::{BlockType, Function, InstructionSink, ValType};

use super::memory::{HEAD, SEGMENT, word};

/// The functions of `Math` with their numbers of arguments.
pub const IMPORTS: [(&str, usize); 11] = [
    ("sin", 1),
    ("cos", 1),
    ("tan", 1),
    ("asin", 1),
    ("acos", 1),
    ("atan", 1),
    ("exp", 1),
    ("log", 1),
    ("tanh", 1),
    ("atan2", 2),
    ("pow", 2),
];

/// The functions behind the imported ones, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Helper {
    /// (sin x, cos x)
    SinCos,
    /// The smaller of two; not a number if either is not.
    Min,
    /// The larger of two, likewise.
    Max,
    /// −1, 0 or 1; what is not a number stays so.
    Sign,
    /// The second where the first, which is 0 or 1, is 1; else 0.
    Gate,
    /// The derivative of a spline: x, its address, the order.
    Interpolate,
}

impl Helper {
    /// Its position among the functions of the module.
    pub fn index(self) -> u32 {
        IMPORTS.len() as u32 + self as u32
    }

    /// The one that computes the elementary function of this name.
    pub fn named(name: &str) -> Option<Self> {
        [("min", Self::Min), ("max", Self::Max), ("sign", Self::Sign), ("gate", Self::Gate)]
            .into_iter()
            .find_map(|(of, helper)| (of == name).then_some(helper))
    }
}

/// The position of a function of the host.
pub fn import(name: &str) -> Option<u32> {
    IMPORTS.iter().position(|(import, _)| *import == name).map(|at| at as u32)
}

/// A function of the module.
pub struct Written {
    pub parameters: Vec<ValType>,
    pub results: Vec<ValType>,
    pub body: Function,
}

/// In the order of [`Helper`].
pub fn all() -> [Written; 6] {
    use ValType::{F64, I32};
    let written = |parameters: &[ValType], results: &[ValType], body| Written {
        parameters: parameters.to_vec(),
        results: results.to_vec(),
        body,
    };
    [
        written(&[F64], &[F64, F64], sin_cos()),
        written(&[F64, F64], &[F64], extreme(|code| code.f64_lt())),
        written(&[F64, F64], &[F64], extreme(|code| code.f64_gt())),
        written(&[F64], &[F64], sign()),
        written(&[F64, F64], &[F64], gate()),
        written(&[F64, I32, I32], &[F64], interpolate()),
    ]
}

/// a if it compares so with b, or is not a number, else b.
fn extreme(compare: for<'a, 'b> fn(&'a mut InstructionSink<'b>) -> &'a mut InstructionSink<'b>) -> Function {
    let mut function = Function::new([]);
    let mut code = function.instructions();
    code.local_get(0).local_get(1).local_get(0).local_get(1);
    compare(&mut code).local_get(0).local_get(0).f64_ne().i32_or().select().end();
    function
}

fn sign() -> Function {
    let mut function = Function::new([]);
    let zero = || 0.0.into();
    let mut code = function.instructions();
    code.f64_const(1.0.into());
    code.f64_const((-1.0).into()).local_get(0).local_get(0).f64_const(zero()).f64_lt().select();
    code.local_get(0).f64_const(zero()).f64_gt().select().end();
    function
}

fn gate() -> Function {
    let mut function = Function::new([]);
    let mut code = function.instructions();
    code.f64_const(0.0.into()).local_get(1).local_get(0).f64_const(0.0.into()).f64_eq().select().end();
    function
}

/// Sine and cosine as `mbs-runtime` computes them: the quarter turns are taken off by Cody and Waite's
/// reduction, polynomials of Sun's fdlibm give the rest. Beyond 10⁹ rad the host computes them.
fn sin_cos() -> Function {
    let mut function = Function::new([(11, ValType::F64), (1, ValType::I64)]);
    let [x, turns, shifted, n, near, r, z, y, w, ww, s, c] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];
    let quadrant = 12;
    let mut code = function.instructions();
    code.local_get(x).f64_abs().f64_const(RANGE.into()).f64_le().i32_eqz().if_(BlockType::Empty);
    code.local_get(x).call(0).local_get(x).call(1).return_().end();
    // the low bits of the sum are the nearest number of quarter turns
    code.local_get(x).f64_const(std::f64::consts::FRAC_2_PI.into()).f64_mul().local_tee(turns);
    code.f64_const(SHIFT.into()).f64_add().local_tee(shifted).f64_const(SHIFT.into()).f64_sub().local_set(n);
    code.local_get(x);
    let [high, middle, low] = HALF_PI;
    for part in [high, middle] {
        code.local_get(n).f64_const(part.into()).f64_mul().f64_sub();
    }
    // r² is taken without the last part of π/2, which matters only where r itself is tiny
    code.local_tee(near).local_get(n).f64_const(low.into()).f64_mul().f64_sub().local_set(r);
    code.local_get(near).local_get(near).f64_mul().local_set(z);
    // q², of which the far terms are computed, and its powers
    code.local_get(turns).local_get(n).f64_sub().local_tee(y).local_get(y).f64_mul().local_tee(y);
    code.local_get(y).f64_mul().local_tee(w).local_get(w).f64_mul().local_set(ww);
    // s = r + r z (first + (w second + w² third))
    code.local_get(r).local_get(r).local_get(z).f64_mul();
    polynomial(&mut code, [z, y, w, ww], SINE);
    code.f64_mul().f64_add().local_set(s);
    // c = 1 − (z/2 − z² (first + (w second + w² third)))
    code.f64_const(1.0.into()).f64_const(0.5.into()).local_get(z).f64_mul();
    code.local_get(z).local_get(z).f64_mul();
    polynomial(&mut code, [z, y, w, ww], COSINE);
    code.f64_mul().f64_sub().f64_sub().local_set(c);
    // odd quarter turns exchange the two; the sine is negative in the second half of a turn, the cosine
    // in the second and the third quarter
    code.local_get(shifted).i64_reinterpret_f64().local_set(quadrant);
    for (even, odd, turned) in [(s, c, 0), (c, s, 1)] {
        code.local_get(odd)
            .local_get(even)
            .local_get(quadrant)
            .i64_const(1)
            .i64_and()
            .i32_wrap_i64()
            .select();
        code.i64_reinterpret_f64();
        code.local_get(quadrant).i64_const(turned).i64_add().i64_const(2).i64_and().i64_const(62).i64_shl();
        code.i64_xor().f64_reinterpret_i64();
    }
    code.end();
    function
}

/// (c₀ + c₁z) + (w (c₂ + c₃y) + w² (c₄ + c₅y))
fn polynomial(code: &mut InstructionSink<'_>, [z, y, w, ww]: [u32; 4], [c0, c1, c2, c3, c4, c5]: [f64; 6]) {
    pair_of_terms(code, z, [c0, c1]);
    code.local_get(w);
    pair_of_terms(code, y, [c2, c3]);
    code.f64_mul().local_get(ww);
    pair_of_terms(code, y, [c4, c5]);
    code.f64_mul().f64_add().f64_add();
}

/// c₀ + c₁z
fn pair_of_terms(code: &mut InstructionSink<'_>, z: u32, [c0, c1]: [f64; 2]) {
    code.f64_const(c0.into()).local_get(z).f64_const(c1.into()).f64_mul().f64_add();
}

/// The segment that x lies in is the last that does not begin behind it, and u counts from there.
fn interpolate() -> Function {
    let (x, spline, order) = (0, 1, 2);
    let (u, c0, c1, c2, c3) = (3, 4, 5, 6, 7);
    let (segment, steps, middle) = (8, 9, 10);
    let mut function = Function::new([(5, ValType::F64), (3, ValType::I32)]);
    let mut code = function.instructions();
    let bytes = |numbers: usize| 8 * numbers as i32;
    // u = x − origin, less whole periods
    code.local_get(x).local_get(spline).f64_load(word(0)).f64_sub().local_set(u);
    code.local_get(spline).f64_load(word(1)).f64_const(0.0.into()).f64_gt().if_(BlockType::Empty);
    code.local_get(u).local_get(u).local_get(spline).f64_load(word(1)).f64_div().f64_floor();
    code.local_get(spline).f64_load(word(1)).f64_mul().f64_sub().local_set(u).end();
    // the segment is one of so many steps from here on
    code.local_get(spline).i32_const(bytes(HEAD)).i32_add().local_set(segment);
    code.local_get(spline).f64_load(word(2)).i32_trunc_sat_f64_s().i32_const(1).i32_sub().local_set(steps);
    code.block(BlockType::Empty).loop_(BlockType::Empty);
    code.local_get(steps).i32_eqz().br_if(1);
    // from the middle on, if that begins at u or before, else before it
    code.local_get(steps).i32_const(1).i32_add().i32_const(1).i32_shr_u().i32_const(bytes(SEGMENT)).i32_mul();
    code.local_get(segment).i32_add().local_tee(middle).f64_load(word(0)).local_get(u).f64_le();
    code.if_(BlockType::Empty).local_get(middle).local_set(segment);
    code.local_get(steps).i32_const(1).i32_shr_u().local_set(steps).else_();
    code.local_get(steps).i32_const(1).i32_sub().i32_const(1).i32_shr_u().local_set(steps).end();
    code.br(0).end().end();
    // x − x is 0, or not a number
    code.local_get(u).local_get(segment).f64_load(word(0)).f64_sub();
    code.local_get(x).local_get(x).f64_sub().f64_add().local_set(u);
    for (at, coefficient) in [c0, c1, c2, c3].into_iter().enumerate() {
        code.local_get(segment).f64_load(word(1 + at)).local_set(coefficient);
    }
    // 2·c₂ and so on in the order of `mbs-runtime`
    let cubic: [&[(u32, f64)]; 4] = [
        &[(c0, 1.0), (c1, 1.0), (c2, 1.0), (c3, 1.0)],
        &[(c1, 1.0), (c2, 2.0), (c3, 3.0)],
        &[(c2, 2.0), (c3, 6.0)],
        &[(c3, 6.0)],
    ];
    for (at, terms) in cubic.into_iter().enumerate() {
        code.local_get(order).i32_const(at as i32).i32_eq().if_(BlockType::Empty);
        horner(&mut code, terms, u);
        code.return_().end();
    }
    code.f64_const(f64::NAN.into()).end();
    function
}

/// t₀ + u (t₁ + u (…)), where a term is a number times a local; a product with 1 is exact.
fn horner(code: &mut InstructionSink<'_>, terms: &[(u32, f64)], u: u32) {
    for (at, (local, factor)) in terms.iter().enumerate() {
        if at > 0 {
            code.local_get(u);
        }
        code.f64_const((*factor).into()).local_get(*local).f64_mul();
    }
    for _ in 1..terms.len() {
        code.f64_mul().f64_add();
    }
}
