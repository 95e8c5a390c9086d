use mbs_runtime::mechanism;

mechanism! {
    Headers {
        dof = 0;
        const N = 3;
        const share = 1/2;
        for i 1..=3 { }
        for i in 1..=missing { }
        for i in 1..=share { }
        for i in ..3 { }
        for i in 1, 3 { }
        for i in 1..=3 body
        for m in 1..=3 { let a[m] = m; }
        for N in 1..=3 { let b[N] = N; }
        for i in 1..=2 { for i in 1..=2 { let c[i] = 1; } }
        if N { let d = 1; }
        if N = 3 { let d = 1; }
        if N == 3 let d = 1;
    }
}

mechanism! {
    Indices {
        dof = 1;
        for i in 1..=3 {
            body link[i] (x[i], y[k], theta[i]) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        }
        let above = theta[j] + theta[-1];
        let stretched = theta[1/2];
        param length[i] = 1 [m];
    }
}

mechanism! {
    // an error in a loop is reported once, not for every copy
    Copies {
        dof = 9;
        for i in 1..=3 {
            body link[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            torque push[i] on link[i] = 1 [N];
            output last[i] [m] = x[i+1];
        }
        output beyond = y[0];
    }
}

mechanism! {
    TooMany {
        dof = 1;
        for i in 1..=1000 { for j in 1..=1000 { let a[i, j] = 1; } }
        for i in 1..=1000 { for j in 1..=1000 { let b[i][j] = 1; } }
        for i in 1..=2147483647 { }
        for i in 1..=2147483647 { for j in 1..=0 { let c[i][j] = 1; } }
    }
}

fn main() {}
