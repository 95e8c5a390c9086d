//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

mod paper;

use std::process::ExitCode;

fn main() -> ExitCode {
    mbs_workbench::app()
        .mechanism::<models::SliderCrank>("slider-crank")
        .mechanism::<models::SliderCrankFree>("slider-crank-free")
        .mechanism::<models::Pendulum>("pendulum")
        .mechanism::<models::DoublePendulum>("double-pendulum")
        .mechanism::<models::CartPendulum>("cart-pendulum")
        .mechanism::<models::SpringMassDamper>("spring-mass-damper")
        .mechanism::<models::FourBar>("four-bar")
        .mechanism::<models::FourBarFree>("four-bar-free")
        .mechanism::<models::QuickReturn>("quick-return")
        .mechanism::<models::ScotchYoke>("scotch-yoke")
        .mechanism::<models::GenevaPinSlot>("geneva-pin-slot")
        .mechanism::<models::TogglePress>("toggle-press")
        .mechanism::<models::VEngine>("v-engine")
        .mechanism::<models::Excavator>("excavator")
        .mechanism::<models::AndrewsSqueezer>("andrews-squeezer")
        .mechanism::<models::Peaucellier>("peaucellier")
        .mechanism::<models::HartInversor>("hart-inversor")
        .mechanism::<models::Chebyshev>("chebyshev")
        .mechanism::<models::WattLinkage>("watt-linkage")
        .mechanism::<models::TrammelOfArchimedes>("trammel-of-archimedes")
        .mechanism::<models::Pantograph>("pantograph")
        .mechanism::<models::Jansen>("jansen")
        .mechanism::<models::Klann>("klann")
        .command(paper::command(), paper::run)
        .default_command("paper")
        .run()
}
