//! The mechanisms of the library, as the texts that they are declared in.

use mbs_live::Text;
use mbs_workbench::Settings;

/// A mechanism of the library.
pub struct Entry {
    /// The name under which commands know it.
    pub name: &'static str,
    /// The type of the crate `models` that its declaration makes; a text makes none.
    pub mechanism: Option<&'static str>,
    file: &'static str,
    source: &'static str,
}

/// Those of types by their names, files and types, and those of texts by their names.
macro_rules! entries {
    ($($name:literal, $file:literal, $mechanism:literal;)* texts: $($text:literal;)*) => {
        &[$(Entry {
            name: $name,
            mechanism: Some($mechanism),
            file: concat!("src/", $file),
            source: include_str!(concat!("../../src/", $file)),
        },)* $(Entry {
            name: $text,
            mechanism: None,
            file: concat!("texts/", $text, ".mbs"),
            source: include_str!(concat!("../../texts/", $text, ".mbs")),
        },)*]
    };
}

/// In the order of `mbs list`.
static LIBRARY: &[Entry] = entries! {
    "slider-crank", "slider_crank.rs", "SliderCrank";
    "slider-crank-free", "slider_crank_free.rs", "SliderCrankFree";
    "pendulum", "pendulum.rs", "Pendulum";
    "double-pendulum", "double_pendulum.rs", "DoublePendulum";
    "n-pendulum-1", "n_pendulum.rs", "NPendulum1";
    "n-pendulum-2", "n_pendulum.rs", "NPendulum2";
    "n-pendulum-10", "n_pendulum.rs", "NPendulum10";
    "n-pendulum-40", "n_pendulum.rs", "NPendulum40";
    "cart-pendulum", "cart_pendulum.rs", "CartPendulum";
    "spring-mass-damper", "spring_mass_damper.rs", "SpringMassDamper";
    "metronome", "metronome.rs", "Metronome";
    "block-on-incline", "block_on_incline.rs", "BlockOnIncline";
    "four-bar", "four_bar.rs", "FourBar";
    "four-bar-free", "four_bar_free.rs", "FourBarFree";
    "n-four-bar-1", "n_four_bar.rs", "NFourBar1";
    "n-four-bar-2", "n_four_bar.rs", "NFourBar2";
    "n-four-bar-10", "n_four_bar.rs", "NFourBar10";
    "n-four-bar-40", "n_four_bar.rs", "NFourBar40";
    "quick-return", "quick_return.rs", "QuickReturn";
    "scotch-yoke", "scotch_yoke.rs", "ScotchYoke";
    "geneva-pin-slot", "geneva_pin_slot.rs", "GenevaPinSlot";
    "cam-follower", "cam_follower.rs", "CamFollower";
    "toggle-press", "toggle_press.rs", "TogglePress";
    "v-engine", "v_engine.rs", "VEngine";
    "excavator", "excavator.rs", "Excavator";
    "tipper", "tipper.rs", "Tipper";
    "andrews-squeezer", "andrews_squeezer.rs", "AndrewsSqueezer";
    "planetary-gear", "planetary_gear.rs", "PlanetaryGear";
    "geared-motor", "geared_motor.rs", "GearedMotor";
    "dc-motor", "dc_motor.rs", "DcMotor";
    "suspension", "suspension.rs", "Suspension";
    "crane-rope", "crane_rope.rs", "CraneRope";
    "brake", "brake.rs", "Brake";
    "engine", "engine.rs", "Engine";
    "boom-cylinder", "boom_cylinder.rs", "BoomCylinder";
    "chaplygin-sleigh", "chaplygin_sleigh.rs", "ChaplyginSleigh";
    "differential-drive", "differential_drive.rs", "DifferentialDrive";
    "cart-pole", "cart_pole.rs", "CartPole";
    "path-follower", "path_follower.rs", "PathFollower";
    "elastic-crank", "elastic_crank.rs", "ElasticCrank";
    "drop-hammer", "drop_hammer.rs", "DropHammer";
    "newtons-cradle", "newtons_cradle.rs", "NewtonsCradle";
    "peaucellier", "peaucellier.rs", "Peaucellier";
    "hart-inversor", "hart_inversor.rs", "HartInversor";
    "chebyshev", "chebyshev.rs", "Chebyshev";
    "watt-linkage", "watt_linkage.rs", "WattLinkage";
    "trammel-of-archimedes", "trammel_of_archimedes.rs", "TrammelOfArchimedes";
    "pantograph", "pantograph.rs", "Pantograph";
    "jansen", "jansen.rs", "Jansen";
    "jansen-walker", "jansen_walker.rs", "JansenWalker";
    "klann", "klann.rs", "Klann";
    texts:
    "clearance-crank";
    "geneva-contact";
    "ratchet";
    "escapement";
    "one-way-clutch";
    "toggle-latch";
    "door-closer";
    "bumper";
    "valve-train";
    "stick-slip";
    "rocking-block";
    "compass-walker";
};

/// The mechanisms of the library, in the order of `mbs list`.
pub fn library() -> &'static [Entry] {
    LIBRARY
}

impl Entry {
    /// The declaration.
    pub fn text(&self) -> Text {
        let file = format!("models/{}", self.file);
        let Some(mechanism) = self.mechanism else { return Text::declaration(file, self.source) };
        // the name tells them apart where a file has several
        let source = chain(self.source, mechanism).unwrap_or_else(|| self.source.to_owned());
        Text::rust(file, source)
    }

    /// The settings of its runs where nothing else is said.
    pub fn defaults(&self) -> Settings {
        match self.name {
            // 20 000 steps that have to follow 300 rad/s
            "andrews-squeezer" => Settings { step: 20e-6, end: 0.4, ..Settings::default() },
            "crane-rope" => Settings { end: 8.0, ..Settings::default() },
            "brake" => Settings { end: 16.0, ..Settings::default() },
            "engine" => Settings { end: 2.0, ..Settings::default() },
            "boom-cylinder" => Settings { end: 8.0, ..Settings::default() },
            "cart-pole" => Settings { end: 5.0, ..Settings::default() },
            // steps that follow 1277 rad/s, over some turns
            "elastic-crank" => Settings { step: 20e-6, end: 0.2, ..Settings::default() },
            "path-follower" => Settings { end: 12.0, ..Settings::default() },
            // as far as a page shows a turn
            "chaplygin-sleigh" | "differential-drive" => Settings { end: 4.0, ..Settings::default() },
            "drop-hammer" => Settings { end: 6.0, ..Settings::default() },
            "bumper" => Settings { step: 1e-4, end: 3.0, ..Settings::default() },
            "one-way-clutch" => Settings { end: 3.0, ..Settings::default() },
            "clearance-crank" => Settings { step: 10e-6, end: 0.1, ..Settings::default() },
            "compass-walker" => Settings { end: 4.38, ..Settings::default() },
            "door-closer" => Settings { step: 1e-3, end: 6.5, ..Settings::default() },
            "escapement" => Settings { step: 1e-4, end: 4.032, ..Settings::default() },
            "geneva-contact" => Settings { step: 20e-6, end: 2.0, ..Settings::default() },
            "ratchet" => Settings { step: 40e-6, end: 2.0, ..Settings::default() },
            "rocking-block" => Settings { end: 7.5, ..Settings::default() },
            "stick-slip" => Settings { end: 3.98, ..Settings::default() },
            "toggle-latch" => Settings { step: 0.2e-3, end: 2.2, ..Settings::default() },
            "valve-train" => Settings { step: 10e-6, end: 0.4, ..Settings::default() },
            "newtons-cradle" => Settings { end: 3.0, ..Settings::default() },
            _ => Settings::default(),
        }
    }
}

/// The block of a mechanism that a file makes for several lengths by `macro_rules!`: with
/// the name, the length and the documentation of one of its uses, `Name, 10`.
fn chain(source: &str, mechanism: &str) -> Option<String> {
    let mut doc = "";
    for line in source.lines().map(str::trim) {
        if let Some(length) = line.strip_prefix(mechanism).and_then(|rest| rest.strip_prefix(", ")) {
            let filled = source.replace("$(#[$($attribute)*])*", doc);
            return Some(filled.replace("$Name", mechanism).replace("$n", length));
        }
        doc = line;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::chain;

    #[test]
    fn a_chain_is_the_block_of_its_macro_filled_in() {
        let source = "macro_rules! chain { ($Name) => { mechanism! {\n$(#[$($attribute)*])*\npub $Name { dof = $n; } } } }
            chain! {\n    /// One.\n    Chain1, 1\n}\nchain! {\n    /// Ten.\n    Chain10, 10\n}";
        let ten = chain(source, "Chain10").unwrap();
        assert!(ten.contains("mechanism! {\n/// Ten.\npub Chain10 { dof = 10; }"), "{ten}");
        assert_eq!(chain(source, "Chain2"), None);
    }
}
