//! A module with the functions of `Math` that it imports, and vectors in its memory.

use wasmi::{Caller, Engine, Func, Instance, Linker, Memory, Module, Store, Val};

/// An argument of a function.
#[derive(Clone, Copy)]
pub enum Given<'a> {
    Number(f64),
    Vector(&'a [f64]),
}

pub struct Host {
    store: Store<()>,
    instance: Instance,
    memory: Memory,
    /// The address of the parameters and what depends on them.
    mechanism: i32,
    /// The first free address.
    free: i32,
}

impl Host {
    /// A valid module with these parameters, and as much memory as one mechanism needs.
    pub fn new(module: &[u8], parameters: &[f64]) -> Self {
        let engine = Engine::default();
        // this also validates it
        let module = Module::new(&engine, module).unwrap();
        let mut store = Store::new(&engine, ());
        let mut linker = Linker::new(&engine);
        type Elementary = fn(f64) -> f64;
        let one: [(&str, Elementary); 9] = [
            ("sin", f64::sin),
            ("cos", f64::cos),
            ("tan", f64::tan),
            ("asin", f64::asin),
            ("acos", f64::acos),
            ("atan", f64::atan),
            ("exp", f64::exp),
            ("log", f64::ln),
            ("tanh", f64::tanh),
        ];
        for (name, function) in one {
            let function = Func::wrap(&mut store, move |_: Caller<'_, ()>, x: f64| function(x));
            linker.define("math", name, function).unwrap();
        }
        for (name, function) in [("atan2", f64::atan2 as fn(f64, f64) -> f64), ("pow", f64::powf)] {
            let function = Func::wrap(&mut store, move |_: Caller<'_, ()>, x: f64, y: f64| function(x, y));
            linker.define("math", name, function).unwrap();
        }
        let instance = linker.instantiate_and_start(&mut store, &module).unwrap();
        let memory = instance.get_memory(&store, "memory").unwrap();
        memory.grow(&mut store, 16).unwrap();
        let Val::I32(heap) = instance.get_global(&store, "heap").unwrap().get(&store) else {
            panic!("no address")
        };
        let mut host = Self { store, instance, memory, mechanism: heap, free: heap + 8 * 4096 };
        host.write(heap, parameters);
        let hoisted = heap + 8 * parameters.len() as i32;
        let new = host.instance.get_func(&host.store, "new").unwrap();
        new.call(&mut host.store, &[Val::I32(heap), Val::I32(hoisted)], &mut []).unwrap();
        host
    }

    pub fn has(&self, name: &str) -> bool {
        self.instance.get_func(&self.store, name).is_some()
    }

    /// The results of a function, vectors of these lengths and behind them what it returns.
    pub fn call(&mut self, name: &str, given: &[Given<'_>], lengths: &[usize]) -> Vec<Vec<f64>> {
        let mut free = self.free;
        let mut arguments = vec![Val::I32(self.mechanism)];
        for argument in given {
            match argument {
                Given::Number(number) => arguments.push(Val::F64((*number).into())),
                Given::Vector(vector) => {
                    self.write(free, vector);
                    arguments.push(Val::I32(free));
                    free += 8 * vector.len() as i32;
                }
            }
        }
        let mut addresses = Vec::new();
        for length in lengths {
            addresses.push(free);
            arguments.push(Val::I32(free));
            free += 8 * *length as i32;
        }
        let function = self.instance.get_func(&self.store, name).unwrap();
        let mut returned = vec![Val::F64(0.0.into()); function.ty(&self.store).results().len()];
        function.call(&mut self.store, &arguments, &mut returned).unwrap();
        let mut results: Vec<Vec<f64>> =
            addresses.iter().zip(lengths).map(|(&address, &length)| self.read(address, length)).collect();
        results.extend(returned.iter().map(|value| match value {
            Val::F64(number) => vec![f64::from_bits(number.to_bits())],
            _ => panic!("functions return numbers"),
        }));
        results
    }

    fn write(&mut self, address: i32, numbers: &[f64]) {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.memory.write(&mut self.store, address as usize, &bytes).unwrap();
    }

    fn read(&self, address: i32, length: usize) -> Vec<f64> {
        let mut bytes = vec![0; 8 * length];
        self.memory.read(&self.store, address as usize, &mut bytes).unwrap();
        bytes.as_chunks::<8>().0.iter().map(|number| f64::from_le_bytes(*number)).collect()
    }
}
