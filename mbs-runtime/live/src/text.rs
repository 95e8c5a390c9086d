//! A declaration as text.
//!
//! A declaration is data. The compiler runs on a thread of its own, with bounds on length, nesting and time.

#[cfg(not(target_family = "wasm"))]
use std::fmt::Display;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
#[cfg(not(target_family = "wasm"))]
use std::sync::mpsc::{self, RecvTimeoutError};
#[cfg(not(target_family = "wasm"))]
use std::thread;
use std::time::Duration;

use mbs_codegen::compiled::Choices;
use mbs_codegen::{Compiled, Diagnostic, Diagnostics};
use mbs_runtime::{Baumgarte, Held, PerStage};
use proc_macro2::{Span, TokenStream};

use crate::error::{Error, Problem, Warnings};
use crate::live::{Live, Programs};
use crate::{find, folder, lexing};

/// The longest text that is compiled, in bytes.
pub const LONGEST: usize = 1 << 20;

/// The stack of the compiler where it is not optimised, in bytes; it descends into formulas and
/// groups by recursion, at most as deep as it allows them to nest.
#[cfg(not(target_family = "wasm"))]
const STACK: usize = 64 << 20;

/// A declaration of a mechanism as text: a file of its own, or a Rust file with a block
/// `mechanism! { … }`.
///
/// # Bounds
/// A declaration is data: nothing in it runs a program. It reads no file but those of its own tables, which are in
/// [its folder](Self::in_folder), if it has one. Its text, and each of these, is at most [`LONGEST`] bytes. The compiler bounds how deep groups (256), formulas (128),
/// blocks (64) and assemblies (16) nest, how many statements loops make (100,000), and how
/// many instances there are (10,000): what is over a bound is an error. Time and memory grow
/// with the number of statements that are left then. A program that opens files of
/// strangers sets a limit of time by [`within`](Self::within).
///
/// # Example
/// ```
/// use mbs_live::Text;
///
/// let wrong = Text::declaration("crank.mbs", "Crank {\n    dof = 1;\n    body wheel (phi { }\n}");
/// let error = wrong.compile().unwrap_err();
/// let problem = &error.problems()[0];
/// assert_eq!(problem.message, "this bracket does not close the one that is open");
/// let place = problem.location.as_ref().unwrap();
/// assert_eq!((place.line, place.column, place.length), (4, 1, 1));
/// assert_eq!(problem.notes[0].location.as_ref().unwrap().line, 3);
/// ```
#[derive(Clone, Debug)]
pub struct Text {
    file: String,
    text: String,
    form: Form,
    limit: Option<Duration>,
    /// Where the files of tables are.
    folder: Option<PathBuf>,
}

/// The form of a text.
#[derive(Clone, Debug)]
enum Form {
    /// The inside of `mechanism! { … }`.
    Declaration,
    /// Rust with such a block, called by name where one was asked for.
    Rust(Option<String>),
}

impl Text {
    /// A declaration by itself, the inside of `mechanism! { … }`. Errors name it `file`. See the example of
    /// [`Text`].
    pub fn declaration(file: impl Into<String>, text: impl Into<String>) -> Self {
        Self { file: file.into(), text: text.into(), form: Form::Declaration, limit: None, folder: None }
    }

    /// A Rust file with a block `mechanism! { … }`, the only one unless one is
    /// [`named`](Self::named). See the example there.
    pub fn rust(file: impl Into<String>, text: impl Into<String>) -> Self {
        Self { form: Form::Rust(None), ..Self::declaration(file, text) }
    }

    /// Reads a file: as Rust if its name ends in `.rs`, else as a declaration by itself.
    ///
    /// # Errors
    /// Those of reading a file; one of kind [`InvalidData`](io::ErrorKind::InvalidData) if the text is
    /// not UTF-8. Of a file that is too long no more than [`LONGEST`] and a byte are read; to
    /// compile it is an error.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let path = std::env::temp_dir().join(format!("slider-{}.mbs", std::process::id()));
    /// std::fs::write(&path, "Slider { dof = 1; body block (x) { mass = 1 [kg]; } }")?;
    /// let slider = Text::read(&path)?.compile()?;
    /// assert_eq!(slider.declared_info().name, "Slider");
    /// # std::fs::remove_file(&path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(path: &Path) -> io::Result<Self> {
        let mut bytes = Vec::new();
        File::open(path)?.take(LONGEST as u64 + 1).read_to_end(&mut bytes)?;
        let is_whole = bytes.len() <= LONGEST;
        let text = match String::from_utf8(bytes) {
            Ok(text) => text,
            // cut within a letter
            Err(error) if !is_whole => String::from_utf8_lossy(error.as_bytes()).into_owned(),
            Err(error) => return Err(io::Error::new(io::ErrorKind::InvalidData, error.utf8_error())),
        };
        let file = path.display().to_string();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        let text = if is_rust { Self::rust(file, text) } else { Self::declaration(file, text) };
        Ok(Self { folder: path.parent().map(Path::to_path_buf), ..text })
    }

    /// Lets tables be read from files of a folder and of those in it: `table gas(angle) = from "gas.csv" …;`.
    /// A text that was [`read`](Self::read) has the folder of its file.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let folder = std::env::temp_dir().join(format!("springs-{}", std::process::id()));
    /// std::fs::create_dir_all(&folder)?;
    /// std::fs::write(folder.join("spring.csv"), "x [mm],pull [N]\n0,0\n10,50\n30,400\n")?;
    /// let text = "Block { dof = 1; body block (x) { mass = 1 [kg]; }
    ///     table pull(x) = from \"spring.csv\" linear outside extend;
    ///     force spring on x = -pull(x); }";
    /// let block = Text::declaration("block.mbs", text).in_folder(&folder).compile()?;
    /// assert_eq!(block.declared_info().name, "Block");
    /// // without a folder no file is read
    /// assert!(Text::declaration("block.mbs", text).compile().is_err());
    /// # std::fs::remove_dir_all(&folder)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn in_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = Some(folder.into());
        self
    }

    /// The files of its tables, in the order in which they are read; none of a text without a folder.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Block { dof = 1; body block (x) { mass = 1 [kg]; }
    ///     table pull(x) = from \"spring.csv\" linear outside extend; force spring on x = -pull(x); }";
    /// let block = Text::declaration("block.mbs", text).in_folder("springs");
    /// assert_eq!(block.tables(), [std::path::Path::new("springs/spring.csv")]);
    /// ```
    pub fn tables(&self) -> Vec<PathBuf> {
        let mut files = Vec::new();
        if let (Some(folder), Ok(tokens)) = (&self.folder, self.text.parse::<TokenStream>()) {
            // what is wrong with them is told by compiling
            let _ = mbs_codegen::with_files(tokens, &mut |name| {
                files.push(folder.join(name));
                folder::read(Some(folder), name)
            });
        }
        files
    }

    /// Chooses the block of a Rust file that declares a mechanism of this name. A declaration by itself stays what
    /// it is.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let rust = "mechanism! { pub A { dof = 1; body a (x) { mass = 1 [kg]; } } }
    ///             mechanism! { pub B { dof = 1; body b (x) { mass = 1 [kg]; } } }";
    /// let text = Text::rust("both.rs", rust);
    /// assert!(text.compile().is_err());
    /// assert_eq!(text.named("B").compile()?.declared_info().name, "B");
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        if let Form::Rust(wanted) = &mut self.form {
            *wanted = Some(name.into());
        }
        self
    }

    /// The declaration as it is written, comments and all: of a Rust file the inside of its block, moved to the
    /// left.
    ///
    /// # Errors
    /// Brackets and literals that cannot be read; a Rust file that does not have the block.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let rust = "mechanism! {\n    // sliding\n    Slider {\n        dof = 1;\n    }\n}";
    /// let written = Text::rust("slider.rs", rust).written()?;
    /// assert_eq!(written, "// sliding\nSlider {\n    dof = 1;\n}\n");
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn written(&self) -> Result<String, Error> {
        let Form::Rust(name) = &self.form else { return Ok(self.text.clone()) };
        let tokens =
            self.text.parse().map_err(|error| self.error(vec![lexing::problem(&error, &self.text)]))?;
        let inside = find::inside(tokens, name.as_deref())
            .map_err(|error| self.error(vec![Problem::of(&error, &self.text)]))?;
        Ok(moved_left(self.text.get(inside).unwrap_or_default()))
    }

    /// Compiling ends in an error after this time. Work that was begun goes on in its thread until
    /// it is done; a process that is to end it ends itself.
    ///
    /// # Example
    /// ```
    /// use std::time::Duration;
    ///
    /// use mbs_live::Text;
    ///
    /// // from a stranger
    /// let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } }";
    /// let slider = Text::declaration("slider.mbs", text).within(Duration::from_secs(60)).compile()?;
    /// assert_eq!(slider.declared_info().dof, 1);
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    #[must_use]
    pub fn within(mut self, limit: Duration) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Compiles the declaration: the mechanism with its declared parameters.
    ///
    /// # Errors
    /// All errors of the first stage that has any, as `mechanism!` shows them; brackets
    /// and literals that cannot be read; a Rust file that does not have the block.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    /// use mbs_runtime::equations::{At, Equations};
    ///
    /// let text = "Slider { dof = 1; body block (x) { mass = 3 [kg]; } }";
    /// let slider = Text::declaration("slider.mbs", text).compile()?;
    /// assert_eq!(slider.kinetic_energy(At { t: 0.0, q: &[0.0], v: &[2.0] }), 6.0);
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn compile(&self) -> Result<Live, Error> {
        self.make(programs).map(Live::new)
    }

    /// Compiles the declaration, and tells what of it is likely a mistake although it compiles: parameters, inputs,
    /// definitions and profiles that nothing uses, profiles that leave their dwells.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Slider { dof = 1; param k = 2 [N/m]; body block (x) { mass = 1 [kg]; } }";
    /// let (_, warnings) = Text::declaration("slider.mbs", text).check()?;
    /// assert_eq!(warnings.problems()[0].message, "this parameter is never used");
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    pub fn check(&self) -> Result<(Live, Warnings), Error> {
        let text = self.text.clone();
        let (programs, warnings) = self.make(move |declaration, compiled| {
            let warnings = compiled.warnings.iter().map(|warning| Problem::of(warning, &text));
            let warnings: Vec<_> = warnings.collect();
            Ok((programs(declaration, compiled)?, warnings))
        })?;
        Ok((Live::new(programs), Warnings(self.error(warnings))))
    }

    /// Compiles the declaration with transposed programs, by which
    /// [`gradient_in_reverse`](crate::Builder::gradient_in_reverse) goes back through a run, as if it said
    /// `gradients = reverse;`. That takes up to twice as long. See the example there.
    ///
    /// # Errors
    /// As [`compile`](Self::compile).
    pub fn compile_with_transposes(&self) -> Result<Live, Error> {
        self.make(|declaration, compiled| {
            Programs::new(declaration, compiled)
                .and_then(|programs| programs.with_transposes(compiled))
                .map_err(|mistake| Diagnostic::internal(Span::call_site(), mistake).into())
        })
        .map(Live::new)
    }

    /// Compiles the text, and calls `target` with the declaration as tokens and the compiled mechanism.
    pub(crate) fn make<T: Send + 'static>(
        &self,
        target: impl FnOnce(String, &Compiled) -> Result<T, Diagnostics> + Send + 'static,
    ) -> Result<T, Error> {
        if self.text.len() > LONGEST {
            let message = format!("the text has more than {LONGEST} bytes");
            return Err(self.error(vec![Problem::everywhere(message)]));
        }
        self.apart(target).map_err(|problems| self.error(problems))
    }

    /// Calls [`make`] in a thread with a stack that is deep enough.
    #[cfg(not(target_family = "wasm"))]
    fn apart<T: Send + 'static>(
        &self,
        target: impl FnOnce(String, &Compiled) -> Result<T, Diagnostics> + Send + 'static,
    ) -> Result<T, Vec<Problem>> {
        let (send, receive) = mpsc::channel();
        let (text, form, folder) = (self.text.clone(), self.form.clone(), self.folder.clone());
        // Places of tokens are kept by the thread that made them, and end with it.
        let compiling = thread::Builder::new().stack_size(STACK).spawn(move || {
            // nobody waits any longer if the time was over
            let _ = send.send(make(&text, &form, folder.as_deref(), target));
        });
        if let Err(error) = compiling {
            return Err(vec![Problem::everywhere(format!("no thread to compile in: {error}"))]);
        }
        let made = match self.limit {
            None => receive.recv().ok(),
            Some(limit) => match receive.recv_timeout(limit) {
                Err(RecvTimeoutError::Timeout) => {
                    let message =
                        format!("compiling takes more than the {} s that it may take", limit.as_secs_f64());
                    return Err(vec![Problem::everywhere(message)]);
                }
                made => made.ok(),
            },
        };
        // a thread that sends nothing has panicked
        made.unwrap_or_else(|| Err(vec![internal("it came to an unforeseen end")]))
    }

    /// Calls [`make`] in this thread: WebAssembly has no others. Its host gives the stack, and ends what
    /// takes too long.
    #[cfg(target_family = "wasm")]
    fn apart<T>(
        &self,
        target: impl FnOnce(String, &Compiled) -> Result<T, Diagnostics>,
    ) -> Result<T, Vec<Problem>> {
        make(&self.text, &self.form, None, target)
    }

    fn error(&self, problems: Vec<Problem>) -> Error {
        Error::new(self.file.clone(), self.text.clone(), problems)
    }
}

/// Tokens, declaration, compiled mechanism, and what `target` makes of it.
fn make<T>(
    text: &str,
    form: &Form,
    folder: Option<&Path>,
    target: impl FnOnce(String, &Compiled) -> Result<T, Diagnostics>,
) -> Result<T, Vec<Problem>> {
    let problems = |errors: Diagnostics| -> Vec<Problem> {
        errors.iter().map(|error| Problem::of(error, text)).collect()
    };
    let tokens: TokenStream = text.parse().map_err(|error| vec![lexing::problem(&error, text)])?;
    let declaration = match form {
        Form::Declaration => tokens,
        Form::Rust(name) => find::block(tokens, name.as_deref()).map_err(|error| problems(error.into()))?,
    };
    let declaration =
        mbs_codegen::with_files(declaration, &mut |name| folder::read(folder, name)).map_err(problems)?;
    let key = declaration.to_string();
    let compiled = mbs_codegen::analyse(declaration).map_err(problems)?;
    check_feedback(&compiled).map_err(|error| problems(error.into()))?;
    target(key, &compiled).map_err(problems)
}

/// Compiles the programs that runs of a mechanism need, with transposed ones if the declaration asks for gradients
/// in reverse.
fn programs(declaration: String, compiled: &Compiled) -> Result<Programs, Diagnostics> {
    let programs = Programs::new(declaration, compiled);
    let programs = programs.and_then(|programs| match compiled.choices.has_reverse {
        true => programs.with_transposes(compiled),
        false => Ok(programs),
    });
    programs.map_err(|mistake| Diagnostic::internal(Span::call_site(), mistake).into())
}

/// The lines without the spaces with which all of them begin, and without empty ones around them.
fn moved_left(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    let indent = |line: &&str| line.len() - line.trim_start().len();
    let shared = lines.iter().filter(|line| !line.is_empty()).map(indent).min().unwrap_or(0);
    let moved: Vec<&str> = lines.iter().map(|line| line.get(shared..).unwrap_or_default()).collect();
    format!("{}\n", moved.join("\n").trim_matches('\n'))
}

/// A mistake that is not in the text.
#[cfg(not(target_family = "wasm"))]
fn internal(what: impl Display) -> Problem {
    Problem::of(&Diagnostic::internal(Span::call_site(), what), "")
}

/// Refuses declared gains under which the violation of the constraints would grow, which
/// rustc does where a mechanism is compiled by it.
fn check_feedback(compiled: &Compiled) -> Result<(), Diagnostic> {
    let Choices { step: Some(step), feedback: Some(feedback), .. } = compiled.choices else { return Ok(()) };
    let is_stable = if feedback.is_held {
        Baumgarte::<Held>::new(feedback.alpha, feedback.beta).is_ok_and(|gains| gains.is_stable(step))
    } else {
        Baumgarte::<PerStage>::new(feedback.alpha, feedback.beta).is_ok_and(|gains| gains.is_stable(step))
    };
    if is_stable {
        return Ok(());
    }
    let span = compiled.written.feedback.unwrap_or_else(|| compiled.written.name.span());
    Err(Diagnostic::new(span, feedback.refusal(step)))
}
