/* Sine and cosine of an angle in rad. */
static inline void NAME_sin_cos(real x, real *sine, real *cosine)
{
    *sine = sinf(x);
    *cosine = cosf(x);
}
