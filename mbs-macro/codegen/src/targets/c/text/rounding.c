/* What is no more than this share is rounding: at least that of some operations. */
static double NAME_rounding(double least)
{
    const double operations = 64.0 * (double)NAME_epsilon;
    return operations > least ? operations : least;
}

