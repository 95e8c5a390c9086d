//! Sub-assemblies: every `instance left: Leg { … }` becomes the statements of
//! `assembly Leg { … }` under names of its own, `left_crank`; behind this stage
//! there are plain statements only.
//!
//! Inside an assembly, names mean what it declares, or else what the mechanism
//! around it declares. From outside, `left.crank.tip` is a place and
//! `left.theta` a quantity of the instance.
//!
//! The copies that an instance makes of a statement share its position in the source. Their errors are
//! reported once.

mod names;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;
use syn::ext::IdentExt;

use self::names::Mention;
use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest, two_meanings};
use crate::syntax::{Declaration, FormulaKind, Item, ItemKind, Load, Property};

/// Assemblies within assemblies may nest this deep.
const DEEPEST: usize = 16;

/// More instances than this, within each other too, are a slip.
const MOST_INSTANCES: usize = 10_000;

/// The way to the level that is being flattened.
#[derive(Default)]
struct Way {
    /// The assemblies that it leads through.
    assemblies: Vec<String>,
    /// All instances so far.
    instances: usize,
}

impl Way {
    /// Counts an instance.
    fn enter(&mut self, assembly: &Ident) -> Result<(), Diagnostic> {
        let error = |message: String, help: &str| Err(Diagnostic::new(assembly.span(), message).help(help));
        self.instances += 1;
        let text = assembly.to_string();
        if self.assemblies.contains(&text) {
            return error(
                format!("assembly `{assembly}` contains itself"),
                "an assembly can only use other assemblies",
            );
        }
        if self.assemblies.len() >= DEEPEST {
            return error(
                format!("assemblies are nested more than {DEEPEST} deep here"),
                "declare some of them side by side",
            );
        }
        if self.instances > MOST_INSTANCES {
            return error(
                format!("there are more than {MOST_INSTANCES} instances here"),
                "check how many instances the assemblies have in each other",
            );
        }
        self.assemblies.push(text);
        Ok(())
    }
}

/// Replaces all instances.
///
/// # Errors
/// Unknown assemblies, parameters and instances.
pub fn compose(mut declaration: Declaration) -> Result<Declaration, Diagnostics> {
    let mut errors = Diagnostics::default();
    declaration.items = flatten(declaration.items, &BTreeMap::new(), &mut Way::default(), &mut errors).0;
    let bodies = bodies(&declaration.items);
    for item in &mut declaration.items {
        names::visit(item, &mut |mention| check(&mention, &bodies, &mut errors));
    }
    errors.finish(declaration)
}

type Assemblies = BTreeMap<String, (Ident, Vec<Item>)>;

/// The statements of a level with its instances replaced, and the names of
/// those, instances within instances included.
fn flatten(
    items: Vec<Item>,
    outer: &Assemblies,
    way: &mut Way,
    errors: &mut Diagnostics,
) -> (Vec<Item>, BTreeSet<String>) {
    let mut assemblies = outer.clone();
    let mut instances: BTreeSet<String> = BTreeSet::new();
    let mut flat = Vec::new();
    let mut to_place = Vec::new();
    for item in items {
        match item.kind {
            ItemKind::Assembly { name, items } => match assemblies.get(&name.to_string()) {
                Some((earlier, _)) => errors.push(declared_twice(&name, earlier)),
                None => drop(assemblies.insert(name.to_string(), (name, items))),
            },
            ItemKind::Instance { name, assembly, bindings } => {
                instances.insert(name.to_string());
                to_place.push((flat.len(), name, assembly, bindings));
            }
            kind => flat.push(Item { kind, ..item }),
        }
    }
    let mut placed = Vec::new();
    for (at, name, assembly, bindings) in to_place {
        let Some((_, items)) = errors.take(find(&assembly, &assemblies)) else { continue };
        if way.instances > MOST_INSTANCES || errors.take(way.enter(&assembly)).is_none() {
            continue;
        }
        let (inner, nested) = flatten(items.clone(), &assemblies, way, errors);
        way.assemblies.pop();
        instances.extend(nested.iter().map(|nested| format!("{name}_{nested}")));
        let inner = instantiate(inner, &name, &assembly, bindings, errors);
        placed.push((at, inner));
    }
    // from the last one on, so that positions before it stay what they are
    for (at, inner) in placed.into_iter().rev() {
        flat.splice(at..at, inner);
    }
    for item in &mut flat {
        names::visit(item, &mut |mention| shorten(mention, &instances));
    }
    (flat, instances)
}

fn find<'a>(name: &Ident, assemblies: &'a Assemblies) -> Result<&'a (Ident, Vec<Item>), Diagnostic> {
    let text = name.to_string();
    assemblies.get(&text).ok_or_else(|| {
        let error = Diagnostic::new(name.span(), format!("there is no assembly `{text}`"));
        match nearest(&text, assemblies.keys().map(String::as_str)) {
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None if assemblies.is_empty() => {
                error.help(format!("declare it: `assembly {text} {{ body … }}`"))
            }
            None => error.help(format!("the assemblies are {}", listing(assemblies.keys()))),
        }
    })
}

fn declared_twice(name: &Ident, earlier: &Ident) -> Diagnostic {
    Diagnostic::new(name.span(), format!("assembly `{name}` is declared twice"))
        .note(earlier.span(), format!("`{name}` is first declared here"))
        .help("rename one of them")
}

/// The statements of an assembly under the names of an instance, with bound
/// parameters replaced by definitions.
fn instantiate(
    mut items: Vec<Item>,
    instance: &Ident,
    assembly: &Ident,
    bindings: Vec<Property>,
    errors: &mut Diagnostics,
) -> Vec<Item> {
    let declared = Declared::new(&items);
    check_laws(&items, errors);
    for item in &mut items {
        if let ItemKind::Dof { keyword, .. }
        | ItemKind::Crate { keyword, .. }
        | ItemKind::Gravity { keyword, .. } = &item.kind
        {
            errors.push(
                Diagnostic::new(*keyword, "this belongs to the mechanism, not to an assembly")
                    .help("move it out of the assembly"),
            );
        }
        names::visit(item, &mut |mention| prefix(mention, instance, &declared));
    }
    for Property { name, value } in bindings {
        let wanted = prefixed(instance, &name);
        let bound = items
            .iter()
            .position(|item| matches!(&item.kind, ItemKind::Parameter { name, .. } if *name == wanted));
        let Some(at) = bound else {
            errors.push(unknown_parameter(&name, instance, assembly, &items));
            continue;
        };
        let Item { doc, position, kind } = items.remove(at);
        if let ItemKind::Parameter { name: declared, value: default, condition } = kind {
            // the condition still has to hold
            let of = Some(declared.clone());
            let condition = condition.map(|condition| ItemKind::Require { of, condition });
            let bound = ItemKind::Binding { name: declared, value, default };
            items.extend([Some(bound), condition].into_iter().flatten().map(|kind| Item {
                doc: doc.clone(),
                position,
                kind,
            }));
        }
    }
    items.retain(|item| {
        !matches!(item.kind, ItemKind::Dof { .. } | ItemKind::Crate { .. } | ItemKind::Gravity { .. })
    });
    items
}

/// Refuses a name in a law that means something of its two places, and something else in the assembly.
fn check_laws(items: &[Item], errors: &mut Diagnostics) {
    let quantities: Vec<&Ident> = items.iter().flat_map(names::quantities).collect();
    for item in items {
        let ItemKind::Element(element) = &item.kind else { continue };
        let is_known = |name: &Ident| element.kind.knows.iter().any(|known| name == known.name);
        for property in &element.properties {
            let Load::Scalar(law) = &property.value else { continue };
            for name in law.names().into_iter().filter(|name| is_known(name)) {
                if let Some(declared) = quantities.iter().find(|declared| **declared == name) {
                    errors.push(two_meanings(name, element.kind.word, declared.span()));
                }
            }
        }
    }
}

fn unknown_parameter(name: &Ident, instance: &Ident, assembly: &Ident, items: &[Item]) -> Diagnostic {
    let start = format!("{instance}_");
    let known: Vec<String> = items
        .iter()
        .filter_map(|item| match &item.kind {
            ItemKind::Parameter { name, .. } => name.to_string().strip_prefix(&start).map(str::to_owned),
            _ => None,
        })
        .collect();
    let error = Diagnostic::new(name.span(), format!("assembly `{assembly}` has no parameter `{name}`"));
    match nearest(&name.to_string(), known.iter().map(String::as_str)) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None if known.is_empty() => error.help("it has no parameters that are not bound yet"),
        None => error.help(format!("its parameters are {}", listing(known))),
    }
}

/// The names and points that the statements of an assembly declare.
struct Declared {
    names: BTreeSet<String>,
    /// Points on bodies around the assembly: body and point. Other points go
    /// with their bodies.
    points: BTreeSet<(String, String)>,
}

impl Declared {
    fn new(items: &[Item]) -> Self {
        let names: BTreeSet<String> = items.iter().flat_map(names::declared).collect();
        let points = items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Point { name, body, .. } => Some((body.to_string(), name.to_string())),
                _ => None,
            })
            .filter(|(body, _)| !names.contains(body))
            .collect();
        Self { names, points }
    }
}

/// Names that the assembly declares get the instance's name before them.
fn prefix(mention: Mention<'_>, instance: &Ident, declared: &Declared) {
    let rename = |name: &mut Ident| {
        if declared.names.contains(&name.to_string()) {
            *name = prefixed(instance, name);
        }
    };
    let rename_point = |body: &Ident, point: &mut Ident| {
        if declared.points.contains(&(body.to_string(), point.to_string())) {
            *point = prefixed(instance, point);
        }
    };
    match mention {
        Mention::Point(body, point) => {
            rename_point(body, point);
            rename(body);
        }
        Mention::Name(name) | Mention::Formula(FormulaKind::Name(name)) => rename(name),
        Mention::Place(place) => {
            if let (true, Some(point)) = (place.prefix.is_empty(), &mut place.point) {
                rename_point(&place.body, point);
            }
            rename(place.prefix.first_mut().unwrap_or(&mut place.body));
        }
        Mention::Coordinate(path, name) => rename(path.first_mut().unwrap_or(name)),
        Mention::Formula(FormulaKind::Member(path)) => {
            if let [body, point, ..] = &mut path[..] {
                rename_point(body, point);
            }
            path.iter_mut().take(1).for_each(rename);
        }
        Mention::Function(name) if declared.names.contains(&format!("{name}()")) => {
            *name = prefixed(instance, name);
        }
        Mention::Formula(_) | Mention::Function(_) => {}
    }
}

/// `left.crank` becomes `left_crank` if `left` is an instance.
fn shorten(mention: Mention<'_>, instances: &BTreeSet<String>) {
    let leads = |name: &Ident| instances.contains(&name.to_string());
    match mention {
        Mention::Place(place) => {
            while let [first, ..] = &place.prefix[..]
                && leads(first)
            {
                let first = place.prefix.remove(0);
                let next = place.prefix.first_mut().unwrap_or(&mut place.body);
                *next = prefixed(&first, next);
            }
            // of `left.crank`, the second is no point
            if let Some(point) = &place.point
                && place.prefix.is_empty()
                && leads(&place.body)
            {
                place.body = prefixed(&place.body, point);
                place.point = None;
            }
        }
        Mention::Coordinate(path, name) => {
            while path.first().is_some_and(leads) {
                let first = path.remove(0);
                let next = path.first_mut().unwrap_or(name);
                *next = prefixed(&first, next);
            }
        }
        Mention::Formula(kind) => {
            if let FormulaKind::Member(path) = kind {
                while path.len() > 1 && leads(&path[0]) {
                    let first = path.remove(0);
                    path[0] = prefixed(&first, &path[0]);
                }
                if let [name] = &path[..] {
                    *kind = FormulaKind::Name(name.clone());
                }
            }
        }
        Mention::Name(_) | Mention::Point(..) | Mention::Function(_) => {}
    }
}

/// The bodies by name, with their coordinates.
fn bodies(items: &[Item]) -> BTreeMap<String, Vec<String>> {
    let of_item = |item: &Item| match &item.kind {
        ItemKind::Body { name, coordinates, .. } => {
            Some((name.to_string(), coordinates.iter().map(|c| c.name.to_string()).collect()))
        }
        _ => None,
    };
    items.iter().filter_map(of_item).collect()
}

/// Reports a path that is left in a mention: it leads nowhere.
fn check(mention: &Mention<'_>, bodies: &BTreeMap<String, Vec<String>>, errors: &mut Diagnostics) {
    let first = match mention {
        Mention::Place(place) => place.prefix.first(),
        Mention::Coordinate(path, _) => path.first(),
        _ => None,
    };
    let Some(name) = first else { return };
    let error = match (mention, bodies.get(&name.to_string())) {
        (Mention::Coordinate(..), Some(coordinates)) => {
            let message = format!("`{name}` is a body, where `start` gives values to coordinates");
            Diagnostic::new(name.span(), message)
                .help(format!("write those of `{name}` by their names: {}", listing(coordinates)))
        }
        _ => Diagnostic::new(name.span(), format!("there is no instance `{name}`"))
            .help("a longer path leads through the instances of assemblies: `instance left: Leg;`"),
    };
    errors.push(error);
}

fn prefixed(instance: &Ident, name: &Ident) -> Ident {
    Ident::new(&format!("{instance}_{}", name.unraw()), name.span())
}
