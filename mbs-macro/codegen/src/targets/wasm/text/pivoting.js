// Complementary pivoting: z >= 0 and w = M z + q >= 0, of which one or the other is 0 at each place; see `pivoting.c`.
class Table {
  // Of so many pairs. Variables are w by their places, behind them z, and the artificial one; the constants stand last.
  constructor(count) {
    this.count = count;
    this.rows = Array.from({ length: count }, () => Array(count + 2).fill(0));
    this.basic = Array.from({ length: count }, (_, at) => at);
    this.zero = Array.from({ length: count + 1 }, (_, at) => at + count);
  }

  add(row, column, value) {
    this.rows[row][column] = this.rows[row][column] + value;
  }

  // Finds a solution; true if there is one. Where pivots do not end it tries once more with constants that are moved a little.
  solve() {
    const start = [this.rows.map((row) => row.slice()), this.basic.slice(), this.zero.slice()], last = this.count + 1;
    if (this.pivots()) return true;
    [this.rows, this.basic, this.zero] = start;
    this.rows.forEach((row, at) => { row[last] = row[last] + 1e-9 * (1 + at / 32) * (1 + Math.abs(row[last])); });
    return this.pivots();
  }

  // True if z of a place may be more than 0, and w is 0.
  isActive(at) {
    return this.basic.includes(at + this.count);
  }

  // w of a place.
  rest(at) {
    const row = this.basic.indexOf(at);
    return row < 0 ? 0 : this.rows[row][this.count + 1];
  }

  // The artificial variable enters, then the other one of each pair that has become 0, until it is 0 itself.
  pivots() {
    const { count, rows } = this, last = count + 1;
    const first = rows.reduce((least, row, at) => (row[last] < rows[least][last] ? at : least), 0);
    if (!count || !(rows[first][last] < 0)) return true;
    rows.forEach((row) => { row[count] = 1; });
    let left = this.pivot(first, count);
    for (let pivots = 0; pivots < 16 * count; pivots++) {
      if (left === 2 * count) return true;
      const column = this.zero.indexOf(left < count ? left + count : left - count);
      const row = column < 0 ? -1 : this.leaving(column);
      if (row < 0) return false;
      left = this.pivot(row, column);
    }
    return false;
  }

  // The row that becomes 0 first where a column grows, of several the artificial one, or the first variable; -1 where none does.
  leaving(column) {
    const { count, rows, basic } = this;
    const ratio = (row) => (rows[row][count + 1] > 0 ? rows[row][count + 1] : 0) / -rows[row][column];
    const rank = (row) => (basic[row] === 2 * count ? 0 : basic[row] + 1);
    return rows.reduce((least, entries, row) => {
      if (!(entries[column] < -this.rounding(row))) return least;
      if (least < 0) return row;
      const ofLeast = ratio(least), ofRow = ratio(row);
      const isAlike = Math.abs(ofRow - ofLeast) <= 1e-11 * (ofRow + ofLeast);
      return (isAlike ? rank(row) < rank(least) : ofRow < ofLeast) ? row : least;
    }, -1);
  }

  // Entries of a row up to this size are 0: behind a small pivot they are differences of large ones.
  rounding(row) {
    return this.rows[row].slice(0, this.count + 1).reduce((most, entry) => {
      const size = 1e3 * EPSILON * Math.abs(entry);
      return size > most ? size : most;
    }, 1e-11);
  }

  // Exchanges the variables of a row and of a column; gives that of the row.
  pivot(row, column) {
    const inverse = 1 / this.rows[row][column];
    const above = this.rows[row].map((entry, at) => (at === column ? inverse : -(entry * inverse)));
    this.rows = this.rows.map((entries, at) => {
      if (at === row) return above;
      const factor = entries[column];
      return entries.map((entry, to) => (to === column ? factor * above[to] : entry + factor * above[to]));
    });
    const left = this.basic[row];
    this.basic[row] = this.zero[column];
    this.zero[column] = left;
    return left;
  }
}
