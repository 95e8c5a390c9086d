// A mechanism without stops and without friction that sticks.
class AtStops extends Start {
  touch() {}

  hold() {}

  press() {
    return 0;
  }
}
