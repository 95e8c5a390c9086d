/** Friction at stops. It has two memories more: the direction in which it slides, 0 while it sticks, and the force with which
   it sticks. */

