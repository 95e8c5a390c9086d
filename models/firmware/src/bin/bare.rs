//! The rig without any report: it links only if no panic can be reached, because the panic handler calls a function
//! that does not exist. Nor does an allocator.

#![no_std]
#![no_main]

#[path = "../../../examples/observer/filter.rs"]
mod filter;
#[path = "../../../examples/observer/rig.rs"]
mod rig;
#[path = "../../../src/slider_crank_free.rs"]
mod slider_crank_free;

use core::panic::PanicInfo;

use cortex_m_semihosting::debug;
use slider_crank_free::{SliderCrankFree, SliderCrankFreeCoordinates};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut rig = rig::Rig::new();
    for _ in 0..1000 {
        if let Ok(rig) = &mut rig
            && rig.tick().is_err()
        {
            debug::exit(debug::EXIT_FAILURE);
        }
    }
    // the controller holds the speed
    let holds = rig.is_ok_and(|rig| {
        let error = rig.seen().truth[1] - rig::TARGET;
        -2.5 < error && error < 2.5
    });
    debug::exit(if holds { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}

// A declaration is all there is of this function: a program in which it could be called does not link.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        safe fn a_panic_can_be_reached() -> !;
    }
    a_panic_can_be_reached()
}
