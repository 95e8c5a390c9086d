/* Complementary pivoting: z >= 0 and w = M z + q >= 0, of which one or the other is 0 at each place (Lemke). */

enum { NAME_MOST_PAIRS = CAPS_STOPS + 3 * CAPS_RUBBING };

/* Rows of basic variables by those that are 0, behind them the artificial one and the constants. Variables are w by their
   places, behind them z, and the artificial one. */
struct NAME_table {
    int count, basic[NAME_MOST_PAIRS], zero[NAME_MOST_PAIRS + 1];
    double rows[NAME_MOST_PAIRS][NAME_MOST_PAIRS + 2];
};

static void NAME_begin_table(struct NAME_table *table, int count)
{
    const struct NAME_table nothing = {0};
    *table = nothing;
    table->count = count;
    for (int at = 0; at < NAME_MOST_PAIRS; at++) {
        table->basic[at] = at;
    }
    for (int at = 0; at <= count; at++) {
        table->zero[at] = at + count;
    }
}

/* True if z of a place may be more than 0, and w is 0. */
static int NAME_is_active(const struct NAME_table *table, int at)
{
    for (int row = 0; row < table->count; row++) {
        if (table->basic[row] == at + table->count) {
            return 1;
        }
    }
    return 0;
}

/* w of a place. */
static double NAME_rest_of(const struct NAME_table *table, int at)
{
    for (int row = 0; row < table->count; row++) {
        if (table->basic[row] == at) {
            return table->rows[row][table->count + 1];
        }
    }
    return 0;
}

/* Entries of a row up to this size are 0: behind a small pivot they are differences of large ones. */
static double NAME_rounding_of(const struct NAME_table *table, int row)
{
    double most = 1e-11;
    for (int column = 0; column <= table->count; column++) {
        const double size = 1e3 * 2.220446049250313e-16 * fabs(table->rows[row][column]);
        most = size > most ? size : most;
    }
    return most;
}

/* The row that becomes 0 first where a column grows, of several the artificial one, or the first variable; -1 where none
   does. */
static int NAME_leaving(const struct NAME_table *table, int column)
{
    const int count = table->count;
    int least = -1, least_rank = 0;
    double of_least = 0;
    for (int row = 0; row < count; row++) {
        const double entry = table->rows[row][column], constant = table->rows[row][count + 1];
        if (entry < -NAME_rounding_of(table, row)) {
            const double of_row = (constant > 0 ? constant : 0) / -entry;
            const int rank = table->basic[row] == 2 * count ? 0 : table->basic[row] + 1;
            const int is_alike = fabs(of_row - of_least) <= 1e-11 * (of_row + of_least);
            if (least < 0 || (is_alike ? rank < least_rank : of_row < of_least)) {
                least = row;
                least_rank = rank;
                of_least = of_row;
            }
        }
    }
    return least;
}

/* Exchanges the variables of a row and of a column; gives that of the row. */
static int NAME_pivot(struct NAME_table *table, int row, int column)
{
    const int width = table->count + 2, left = table->basic[row];
    const double inverse = 1.0 / table->rows[row][column];
    double above[NAME_MOST_PAIRS + 2];
    for (int at = 0; at < width; at++) {
        above[at] = at == column ? inverse : -(table->rows[row][at] * inverse);
    }
    for (int at = 0; at < table->count; at++) {
        double *const entries = table->rows[at];
        const double factor = entries[column];
        for (int to = 0; to < width; to++) {
            entries[to] = at == row ? above[to] : to == column ? factor * above[to] : entries[to] + factor * above[to];
        }
    }
    table->basic[row] = table->zero[column];
    table->zero[column] = left;
    return left;
}

/* The artificial variable enters, then the other one of each pair that has become 0, until it is 0 itself. */
static int NAME_try_pivots(struct NAME_table *table)
{
    const int count = table->count;
    int first = 0;
    for (int row = 1; row < count; row++) {
        first = table->rows[row][count + 1] < table->rows[first][count + 1] ? row : first;
    }
    if (count == 0 || !(table->rows[first][count + 1] < 0)) {
        return 1;
    }
    for (int row = 0; row < count; row++) {
        table->rows[row][count] = 1;
    }
    int left = NAME_pivot(table, first, count);
    for (int pivots = 0; pivots < 16 * count; pivots++) {
        if (left == 2 * count) {
            return 1;
        }
        const int enters = left < count ? left + count : left - count;
        int column = 0;
        while (column < count && table->zero[column] != enters) {
            column++;
        }
        const int row = table->zero[column] == enters ? NAME_leaving(table, column) : -1;
        if (row < 0) {
            return 0;
        }
        left = NAME_pivot(table, row, column);
    }
    return 0;
}

/* Finds a solution; true if there is one. Where pivots do not end it tries once more with constants that are moved a
   little. */
static int NAME_find_pivots(struct NAME_table *table)
{
    const struct NAME_table start = *table;
    if (NAME_try_pivots(table)) {
        return 1;
    }
    *table = start;
    for (int row = 0; row < table->count; row++) {
        double *const constant = &table->rows[row][table->count + 1];
        *constant = *constant + 1e-9 * (1.0 + row / 32.0) * (1.0 + fabs(*constant));
    }
    return NAME_try_pivots(table);
}

