//! A mechanism that nobody would build: its constraints use every operator of
//! the language.

mbs_runtime::mechanism! {
    /// Every operator of the language at least once, each away from its kinks.
    pub Operators {
        dof = 1;
        param l = 1 [m] where l > 0;
        param a = 0.7;
        param omega = 2 [rad/s];
        body block (x, y, phi) { mass = 2 [kg]; inertia = 0.3 [kg*m^2]; }

        constraint along: x/l = 0.2*(
            sin(phi)*cos(omega*t) + tan(phi/4) + asin(0.3*y/l) + acos(0.2*y/l) + atan(a*phi)
            + sqrt(2 + sin(phi)) + exp(-phi^2) + ln(3 + cos(phi)) + tanh(phi - omega*t)
        );
        constraint across: y/l = 0.1*(
            abs(3 - phi) + sign(x/l + 5)*phi^3 + min(x/l, 4 + phi) + max(x/l, 4 - phi)
            + atan2(2 + sin(phi), 2 + x/l) + (3 + y/l)^1.5 + (3 + phi)^a - 1/(4 + phi)
        );
        start { phi = 0.4; der(phi) = 1.5 [rad/s]; guess x = 0.5*l; guess y = 1*l; }
    }
}
