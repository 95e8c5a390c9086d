//! `modelDescription.xml`, of both versions of the standard.

use std::collections::BTreeSet;

use super::structure::Dependencies;
use super::units;
use super::variables::{Group, References, Role, Variable};
use super::xml::Element;
use super::{Experiment, Version};
use crate::compiled::Compiled;

/// The data from which a description is written.
pub struct Description<'a> {
    pub compiled: &'a Compiled,
    pub references: &'a References,
    pub variables: &'a [Variable],
    /// The name of the files of code and of the binary.
    pub identifier: &'a str,
    /// The token that ties the description to the binary.
    pub token: &'a str,
    pub experiment: Experiment,
    /// The files of code.
    pub sources: &'a [&'a str],
}

const CATEGORY: &str = "logStatusError";

impl Description<'_> {
    /// The whole document.
    pub fn document(&self, version: Version) -> String {
        let compiled = self.compiled;
        let events = compiled.events.len();
        let is_2 = version == Version::V2;
        let root = Element::new("fmiModelDescription")
            .with("fmiVersion", version.number())
            .with("modelName", &compiled.name)
            .with(if is_2 { "guid" } else { "instantiationToken" }, self.token)
            .maybe("description", described(&compiled.doc))
            .with("generationTool", concat!("mbs ", env!("CARGO_PKG_VERSION")))
            .with("variableNamingConvention", "flat")
            .maybe("numberOfEventIndicators", is_2.then_some(events));
        let category = Element::new("Category").with("name", CATEGORY).with("description", "what went wrong");
        let Experiment { step, end } = self.experiment;
        let start = compiled.start.last().copied().unwrap_or_default();
        let experiment = Element::new("DefaultExperiment")
            .number("startTime", Some(start))
            .number("stopTime", Some(start + end))
            .number("stepSize", Some(step));
        let variables = self.variables.iter().enumerate();
        root.holding(self.interfaces(version))
            .holding([units::definitions(self.variables.iter().map(|it| &it.unit))])
            .holding([Element::new("LogCategories").holding([category]), experiment])
            .holding([
                Element::new("ModelVariables").holding(variables.map(|(at, it)| variable(version, at, it)))
            ])
            .holding([self.structure(version)])
            .document()
    }

    /// Model exchange and co-simulation, with what both can do. Impacts at stops are seen by co-simulation alone, and have
    /// no derivatives.
    fn interfaces(&self, version: Version) -> Vec<Element> {
        let is_smooth = !self.compiled.jumps();
        let interface = |name| {
            let it = Element::new(name).with("modelIdentifier", self.identifier);
            match version {
                Version::V2 => it
                    .with("canNotUseMemoryManagementFunctions", true)
                    .with("canGetAndSetFMUstate", true)
                    .with("canSerializeFMUstate", true)
                    .with("providesDirectionalDerivative", is_smooth),
                Version::V3 => it
                    .with("canGetAndSetFMUState", true)
                    .with("canSerializeFMUState", true)
                    .with("providesDirectionalDerivatives", is_smooth)
                    .with("providesAdjointDerivatives", is_smooth),
            }
        };
        let (exchange, simulation) = (interface("ModelExchange"), interface("CoSimulation"));
        let simulation = simulation.with("canHandleVariableCommunicationStepSize", true);
        let [exchange, simulation] = match version {
            Version::V2 => {
                let files = || self.sources.iter().map(|name| Element::new("File").with("name", name));
                let sources = || [Element::new("SourceFiles").holding(files())];
                let exchange = exchange.with("completedIntegratorStepNotNeeded", true);
                [exchange.holding(sources()), simulation.holding(sources())]
            }
            Version::V3 => [exchange, simulation.number("fixedInternalStepSize", Some(self.experiment.step))],
        };
        is_smooth.then_some(exchange).into_iter().chain([simulation]).collect()
    }

    /// Which variables are results, and what they depend on.
    fn structure(&self, version: Version) -> Element {
        let (compiled, references) = (self.compiled, self.references);
        let dependencies = Dependencies::new(compiled, references);
        let all = |group, dependencies: Vec<BTreeSet<usize>>| {
            let start = references.of(group);
            dependencies.into_iter().enumerate().map(move |(at, it)| (start + at, it)).collect::<Vec<_>>()
        };
        let outputs = all(Group::Outputs, dependencies.outputs());
        let events = all(Group::Events, dependencies.events());
        let velocities = compiled.states.iter().map(|at| references.of(Group::Velocities) + at);
        let mut derivatives: Vec<_> = velocities.map(|at| (at, BTreeSet::from([at]))).collect();
        let accelerations = compiled.states.iter().map(|at| references.of(Group::Accelerations) + at);
        derivatives.extend(accelerations.zip(dependencies.accelerations()));
        let states = compiled.states.iter();
        let mut initial: Vec<usize> = outputs.iter().map(|(at, _)| *at).collect();
        initial.extend(states.map(|at| references.of(Group::Positions) + at));
        initial.extend(derivatives.iter().map(|(at, _)| *at));
        let initial = initial.into_iter().map(|at| (at, None));
        let known = |list: Vec<(usize, BTreeSet<usize>)>| list.into_iter().map(|(at, it)| (at, Some(it)));
        match version {
            Version::V2 => Element::new("ModelStructure").holding(
                [
                    ("Outputs", known(outputs).collect::<Vec<_>>()),
                    ("Derivatives", known(derivatives).collect()),
                    ("InitialUnknowns", initial.collect()),
                ]
                .into_iter()
                .filter(|(_, list)| !list.is_empty())
                .map(|(name, list)| {
                    Element::new(name).holding(list.into_iter().map(|(at, on)| unknown_2(at, on)))
                }),
            ),
            Version::V3 => {
                let named =
                    |name, list: Vec<_>| list.into_iter().map(move |(at, on)| unknown_3(name, at, on));
                Element::new("ModelStructure")
                    .holding(named("Output", known(outputs).collect()))
                    .holding(named("ContinuousStateDerivative", known(derivatives).collect()))
                    .holding(named("InitialUnknown", initial.collect()))
                    .holding(named("EventIndicator", known(events).collect()))
            }
        }
    }
}

/// The first paragraph of a documentation, if there is any.
fn described(doc: &str) -> Option<&str> {
    doc.trim().split("\n\n").next().filter(|text| !text.is_empty())
}

fn variable(version: Version, reference: usize, it: &Variable) -> Element {
    let (causality, variability, initial) = match it.role {
        Role::Time => ("independent", "continuous", None),
        Role::Parameter => ("parameter", "fixed", Some("exact")),
        Role::Tunable => ("parameter", "tunable", Some("exact")),
        // an input is always exact, and says nothing of it
        Role::Input => ("input", "continuous", None),
        Role::Memory => ("local", "discrete", Some("calculated")),
        Role::Local => ("local", "continuous", Some("calculated")),
        Role::Output => ("output", "continuous", Some("calculated")),
    };
    let common = |element: Element| {
        element
            .with("name", &it.name)
            .with("valueReference", reference)
            .maybe("description", described(&it.description))
            .with("causality", causality)
            .with("variability", variability)
            .maybe("initial", initial)
    };
    let [min, max] = it.bounds;
    let number = |element: Element, derivative: Option<usize>| {
        element
            .maybe("unit", Some(&it.unit.name).filter(|name| !name.is_empty()))
            .maybe(
                "displayUnit",
                it.unit.display.as_ref().filter(|_| !it.unit.name.is_empty()).map(|(name, _)| name),
            )
            .number("min", min)
            .number("max", max)
            .number("start", it.start)
            .maybe("derivative", derivative)
    };
    match version {
        // by the place in the list, counted from 1
        Version::V2 => common(Element::new("ScalarVariable"))
            .holding([number(Element::new("Real"), it.derivative_of.map(|at| at + 1))]),
        Version::V3 => number(common(Element::new("Float64")), it.derivative_of),
    }
}

/// Numbers with blanks between them.
fn list(numbers: impl Iterator<Item = usize>) -> String {
    numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(" ")
}

fn unknown_2(at: usize, on: Option<BTreeSet<usize>>) -> Element {
    let on = on.map(|on| list(on.into_iter().map(|at| at + 1)));
    Element::new("Unknown").with("index", at + 1).maybe("dependencies", on)
}

fn unknown_3(name: &'static str, at: usize, on: Option<BTreeSet<usize>>) -> Element {
    Element::new(name).with("valueReference", at).maybe("dependencies", on.map(|on| list(on.into_iter())))
}

/// `sources/buildDescription.xml` of FMI 3.0: how the binary is made.
pub fn build(identifier: &str, sources: &[&str]) -> String {
    let files = sources.iter().map(|name| Element::new("SourceFile").with("name", name));
    let set = Element::new("SourceFileSet").with("language", "C99").holding(files);
    let configuration = Element::new("BuildConfiguration").with("modelIdentifier", identifier);
    Element::new("fmiBuildDescription")
        .with("fmiVersion", Version::V3.number())
        .holding([configuration.holding([set, Element::new("Library").with("name", "m")])])
        .document()
}

/// `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0: the icon, and what it is connected by.
pub fn terminals(variables: &[Variable]) -> String {
    let graphics = |width: f64| {
        Element::new("CoordinateSystem")
            .number("x1", Some(-width))
            .number("y1", Some(-width))
            .number("x2", Some(width))
            .number("y2", Some(width))
    };
    let icon = Element::new("Icon")
        .number("x1", Some(-100.0))
        .number("y1", Some(-100.0))
        .number("x2", Some(100.0))
        .number("y2", Some(100.0));
    let picture = Element::new("GraphicalRepresentation").holding([graphics(100.0), icon]);
    let group = |name: &str, role| {
        let members = variables.iter().filter(|it| it.role == role).map(|it| {
            Element::new("TerminalMemberVariable")
                .with("variableKind", "signal")
                .with("memberName", &it.name)
                .with("variableName", &it.name)
        });
        let members: Vec<Element> = members.collect();
        let terminal = Element::new("Terminal").with("name", name).with("matchingRule", "bus");
        (!members.is_empty()).then(|| terminal.holding(members))
    };
    let terminals: Vec<Element> =
        [group("inputs", Role::Input), group("outputs", Role::Output)].into_iter().flatten().collect();
    let terminals = (!terminals.is_empty()).then(|| Element::new("Terminals").holding(terminals));
    Element::new("fmiTerminalsAndIcons")
        .with("fmiVersion", Version::V3.number())
        .holding([picture])
        .holding(terminals)
        .document()
}
