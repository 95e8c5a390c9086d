// Stops without friction; see `rubbing.js` of those with it.
class AtContacts extends Start {
  // The stop that a friction rubs on; -1 of any other row.
  stopOf() {
    return -1;
  }

  isBorne() {
    return true;
  }

  bounds() {}

  sliding() {}

  // The impulses of an impact, or the forces of a rest, with which rates become W x + b >= 0; nothing where there are none.
  meet({ closed, bound }, b) {
    const impulses = this.answerIfAny(closed.map((it, row) => it || bound[row]), b, bound);
    return impulses && { impulses };
  }

  answerHit(hit, b) {
    return this.meet(hit, b);
  }

  turned(hit) {
    return hit;
  }

  moving(directions) {
    return directions;
  }

  noteDirections() {}
}
