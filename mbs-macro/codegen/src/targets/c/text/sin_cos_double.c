/* Sine and cosine of an angle in rad: the quarter turns are taken off by Cody and Waite's
   reduction, polynomials of Sun's fdlibm give the rest. Both are within 2 units in the last
   place up to 1e3 rad. Up to 1e5 rad, 3e-4 of a unit in the last place of x come to that.
   Beyond, they are those of an angle within half a unit in the last place of x. Beyond 1e9
   rad, the library computes them. */
static inline void NAME_sin_cos(real x, real *sine, real *cosine)
{
    union { real value; uint64_t bits; } shifted, first, second;
    if (!(fabs(x) <= 1.0e9)) {
        *sine = sin(x);
        *cosine = cos(x);
        return;
    }
    /* the low bits of the sum are the nearest number of quarter turns */
    const real turns = x * 0.6366197723675814;
    shifted.value = turns + 6755399441055744.0;
    const real n = shifted.value - 6755399441055744.0;
    const real near = (x - n * 1.5707963267341256) - n * 6.077100506303966e-11;
    const real r = near - n * 2.0222662487959506e-21;
    const real q = turns - n;
    const real z = near * near;
    const real y = q * q;
    const real w = y * y;
    const real ww = w * w;
    const real s = r + (r * z) * ((-1.6666666666666632e-1 + z * 8.33333333332249e-3)
        + (w * (-1.2079500369292745e-3 + y * 4.139578687803403e-5)
        + ww * (-9.284957642210898e-7 + y * 1.4538228299987588e-8)));
    const real c = 1.0 - (0.5 * z - (z * z) * ((4.16666666666666e-2 + z * -1.388888888887411e-3)
        + (w * (1.5099375462927477e-4 + y * -4.139578784591348e-6)
        + ww * (7.737497937081319e-8 + y * -1.0388757947298042e-9))));
    /* odd quarter turns exchange the two; the sine is negative in the second half of a
       turn, the cosine in the second and the third quarter */
    const int is_odd = (int)(shifted.bits & 1);
    first.value = is_odd ? c : s;
    second.value = is_odd ? s : c;
    first.bits ^= (shifted.bits & 2) << 62;
    second.bits ^= ((shifted.bits + 1) & 2) << 62;
    *sine = first.value;
    *cosine = second.value;
}
