//! The tables in the README and the documentation have the rows of the routines.

use etendue_routines::{Routine, tables};

fn names(routines: Vec<Routine>) -> Vec<String> {
    routines.into_iter().map(|routine| routine.name).collect()
}

#[test]
fn tables_have_the_rows_of_the_routines() {
    let mut names = names(etendue_routines::routines::<f32>());
    tables::check(&names).unwrap_or_else(|e| panic!("{e}: cargo bench -p etendue-benches --bench summary -- --tables"));
    // a routine that no table shows, and a row without its routine
    names.push("light tube by magic".to_owned());
    assert!(tables::check(&names).unwrap_err().contains("in no table"));
    names.retain(|name| !name.contains("tube") && name != "cone sample");
    assert!(tables::check(&names).unwrap_err().contains("no routine is called `cone sample`"));
}
