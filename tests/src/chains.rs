//! Declarations of chains of any length, handed to a macro: `mechanism` for a
//! solver, `stringify` for text.

/// N uniform rods, each hung on the one before, free under gravity.
///
/// `pendulum!(mechanism; Pendulum10 10)` declares it; statements may follow.
#[macro_export]
macro_rules! pendulum {
    ($to:ident; $name:ident $n:tt $($more:tt)*) => {
        $to! {
            pub $name {
                dof = $n;
                const N = $n;
                param l = 1 [m] where l > 0;
                param m = 1 [kg] where m > 0;
                gravity = (0, -9.81) [m/s^2];
                for i in 1..=N {
                    body rod[i] (x[i], y[i], theta[i]) { mass = m; inertia = m*l^2/12; }
                    point base on rod[i] = (-l/2, 0);
                    point tip on rod[i] = (l/2, 0);
                    if i == 1 { revolute pin[i] (rod[i].base, ground); }
                    if i > 1 { revolute pin[i] (rod[i-1].tip, rod[i].base); }
                    start { theta[i] = (30*sin(i) - 60) [deg]; }
                }
                $($more)*
            }
        }
    };
}

/// N four-bars side by side, which share their rockers: 2N + 1 uniform bars with
/// one degree of freedom, free under gravity.
#[macro_export]
macro_rules! four_bar {
    ($to:ident; $name:ident $n:tt $($more:tt)*) => {
        $to! {
            pub $name {
                dof = 1;
                const N = $n;
                param l = 1 [m] where l > 0;
                param m = 1 [kg] where m > 0;
                gravity = (0, -9.81) [m/s^2];
                for i in 0..=N {
                    body rocker[i] (x[i], y[i], theta[i]) { mass = m; inertia = m*l^2/12; }
                    point foot on rocker[i] = (-l/2, 0);
                    point head on rocker[i] = (l/2, 0);
                    point pivot[i] on ground = (i*l, 0);
                    revolute foot[i] (rocker[i].foot, ground.pivot[i]);
                    start { theta[i] = 60 [deg]; guess x[i] = i*l + l/4; guess y[i] = 0.433*l; }
                }
                for i in 1..=N {
                    body coupler[i] (xc[i], yc[i], phi[i]) { mass = m; inertia = m*l^2/12; }
                    point left on coupler[i] = (-l/2, 0);
                    point right on coupler[i] = (l/2, 0);
                    revolute left[i] (rocker[i-1].head, coupler[i].left);
                    revolute right[i] (rocker[i].head, coupler[i].right);
                    start { guess xc[i] = i*l; guess yc[i] = 0.866*l; }
                }
                $($more)*
            }
        }
    };
}
