//! Gives the shared library its name, which a program that is linked with it looks for.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let has_soname = std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux" || os == "freebsd");
    if has_soname {
        // without a number: the interface has no version before 1.0
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libmbs.so");
    }
}
