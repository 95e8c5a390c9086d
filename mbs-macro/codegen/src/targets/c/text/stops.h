/** Stops. A step ends as if there were none, and impulses lead it back from the gaps that are closed there (Moreau and
   Jean's time stepping). Each stop has two memories among the inputs, which a run sets: 1 while it is rested on, and the
   sum of its impulses. */

