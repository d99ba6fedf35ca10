//! Programs that map numbers to numbers by the functions of a module, in C and in WGSL.

use core::fmt::Write;
use etendue_shader::*;

/// What a program does.
enum Statement {
    /// Makes a variable from inputs, the first of which is this one.
    Take { name: String, of: Type, first: usize },
    /// Calls a function with these arguments.
    Call { function: usize, arguments: Vec<String>, result: String },
    /// Puts all numbers of a variable into outputs.
    Give { name: String, of: Type },
}

/// A program in the making that takes numbers and returns numbers.
pub(crate) struct Driver<'a> {
    pub(crate) module: &'a Module,
    statements: Vec<Statement>,
    pub(crate) inputs: usize,
    /// What each output is: a field of a result; halves of words are two.
    pub(crate) outputs: Vec<String>,
    /// The words that functions read.
    pub(crate) memory: Vec<u32>,
    /// How many statements come before the call that is worth timing, which is the next one.
    timed: Option<usize>,
}

impl<'a> Driver<'a> {
    pub(crate) fn new(module: &'a Module) -> Self {
        Self { module, statements: Vec::new(), inputs: 0, outputs: Vec::new(), memory: Vec::new(), timed: None }
    }
    pub(crate) fn function(&self, name: &str) -> Option<&'a Function> {
        self.module.functions.iter().find(|function| function.name == name)
    }
    /// A variable from the next inputs.
    pub(crate) fn take(&mut self, of: Type, name: &str) {
        self.statements.push(Statement::Take { name: name.into(), of, first: self.inputs });
        self.inputs += self.module.parts(of).len();
    }
    /// Calls a function with these arguments, of which the first is left out where it takes nothing prepared, and puts all that it returns
    /// into a variable.
    pub(crate) fn call(&mut self, name: &str, arguments: &[&str], result: &str) {
        let function = self.module.functions.iter().position(|function| function.name == name);
        let function = function.unwrap_or_else(|| panic!("there is no {name}"));
        let arguments = &arguments[arguments.len() - self.module.functions[function].parameters.len()..];
        let arguments = arguments.iter().map(|&argument| argument.into()).collect();
        self.statements.push(Statement::Call { function, arguments, result: result.into() });
    }
    /// The same, and returns it.
    pub(crate) fn output(&mut self, name: &str, arguments: &[&str], result: &str) {
        self.call(name, arguments, result);
        let of = self.function(name).unwrap().result;
        self.statements.push(Statement::Give { name: result.into(), of });
        for (place, leaf) in self.places(of, result) {
            self.outputs.push(place.clone());
            if leaf == Leaf::Word {
                self.outputs.push(place);
            }
        }
    }
    /// Says that the next call, of random numbers `u`, is the one whose time matters.
    pub(crate) fn time_next(&mut self) {
        self.timed = Some(self.statements.len());
    }
    /// The numbers of a variable, and what each of them is.
    fn places(&self, of: Type, name: &str) -> Vec<(String, Leaf)> {
        let place = |(field, axis): (Option<usize>, Option<usize>)| {
            let (mut place, leaf) = match (of, field) {
                (Type::Struct(of), Some(field)) => {
                    let field = &self.module.structs[of].fields[field];
                    (format!("{name}.{}", field.name), field.leaf)
                }
                (Type::Leaf(leaf), _) => (name.to_owned(), leaf),
                (Type::Struct(_), None) => panic!("a struct has fields"),
            };
            if let Some(axis) = axis {
                place += [".x", ".y", ".z"][axis];
            }
            (place, leaf)
        };
        self.module.parts(of).into_iter().map(place).collect()
    }
    fn type_name(&self, of: Type, language: &impl Dialect) -> String {
        match of {
            Type::Leaf(leaf) => language.leaf(leaf).to_owned(),
            Type::Struct(index) => struct_name(&self.module.structs[index].name),
        }
    }
    fn called(&self, function: usize, arguments: &[String], memory: Option<&str>) -> String {
        let function = &self.module.functions[function];
        let memory = memory.filter(|_| function.reads_memory());
        let arguments: Vec<&str> = memory.into_iter().chain(arguments.iter().map(String::as_str)).collect();
        format!("{}({})", function_name(&function.name), arguments.join(", "))
    }
    /// Statements in C that read `in` and write `out`, and in functions that need it `memory`.
    fn c_of(&self, statements: &[Statement]) -> String {
        let (mut text, mut out) = (String::new(), 0);
        for statement in statements {
            let _ = match statement {
                Statement::Take { name, of, first } => {
                    let _ = writeln!(text, "    {} {name};", self.type_name(*of, &C));
                    for (k, (place, leaf)) in self.places(*of, name).into_iter().enumerate() {
                        let number = format!("in[{}]", first + k);
                        let value = match leaf {
                            Leaf::Word => format!("etendue_shader_bits({number})"),
                            Leaf::Truth => format!("{number} > 0.5f"),
                            _ => number,
                        };
                        let _ = writeln!(text, "    {place} = {value};");
                    }
                    writeln!(text, "    (void){name};")
                }
                Statement::Call { function, arguments, result } => {
                    let of = self.type_name(self.module.functions[*function].result, &C);
                    writeln!(text, "    {of} {result} = {};", self.called(*function, arguments, Some("memory")))
                }
                Statement::Give { name, of } => {
                    for (place, leaf) in self.places(*of, name) {
                        let numbers = match leaf {
                            // halves of words are numbers
                            Leaf::Word => vec![format!("({place} >> 16)"), format!("({place} & 0xffffu)")],
                            _ => vec![place],
                        };
                        for number in numbers {
                            let _ = writeln!(text, "    out[{out}] = (float){number};");
                            out += 1;
                        }
                    }
                    Ok(())
                }
            };
        }
        text
    }
    /// The program in C: what reads `in` and writes `out`.
    pub(crate) fn c(&self) -> String {
        self.c_of(&self.statements)
    }
    /// If a call is worth timing: what comes before it, and it with what sums all of its result in `sum`.
    pub(crate) fn timed_c(&self) -> Option<[String; 2]> {
        let at = self.timed?;
        let Statement::Call { function, result, .. } = &self.statements[at] else { panic!("no call is next") };
        let places = self.places(self.module.functions[*function].result, result);
        let sum: Vec<String> = places.into_iter().map(|(place, _)| format!("(float){place}")).collect();
        let call = self.c_of(&self.statements[at..=at]);
        Some([self.c_of(&self.statements[..at]), format!("{call}    sum += {};\n", sum.join(" + "))])
    }
    /// The program in WGSL: a function `program` of the numbers of the first input and the first output, which reads and writes them by
    /// `read_bits` and `write`.
    pub(crate) fn wgsl(&self) -> String {
        let (mut text, mut out) = ("fn program(first_in: u32, first_out: u32) {\n".to_owned(), 0);
        for statement in &self.statements {
            let _ = match statement {
                Statement::Take { name, of, first } => {
                    for (k, (place, leaf)) in self.places(*of, name).into_iter().enumerate() {
                        if k == 0 {
                            let _ = writeln!(text, "    var {name}: {};", self.type_name(*of, &Wgsl::default()));
                        }
                        let word = format!("read_bits(first_in + {}u)", first + k);
                        let value = match leaf {
                            Leaf::Word => word,
                            Leaf::Truth => format!("bitcast<f32>({word}) > 0.5f"),
                            _ => format!("bitcast<f32>({word})"),
                        };
                        let _ = writeln!(text, "    {place} = {value};");
                    }
                    Ok(())
                }
                Statement::Call { function, arguments, result } => {
                    writeln!(text, "    let {result} = {};", self.called(*function, arguments, None))
                }
                Statement::Give { name, of } => {
                    for (place, leaf) in self.places(*of, name) {
                        let numbers = match leaf {
                            Leaf::Word => vec![format!("f32({place} >> 16u)"), format!("f32({place} & 0xffffu)")],
                            Leaf::Truth => vec![format!("f32({place})")],
                            _ => vec![place],
                        };
                        for number in numbers {
                            let _ = writeln!(text, "    write(first_out + {out}u, {number});");
                            out += 1;
                        }
                    }
                    Ok(())
                }
            };
        }
        text + "}\n"
    }
}
