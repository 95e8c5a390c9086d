// A mechanism without stops and without friction that sticks.
class AtStops extends Start {
  touch() {}

  press() {
    return 0;
  }
}
