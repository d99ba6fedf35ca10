//! The images of all scenes have the bits of `render/bits/images.txt`, and every difference is named.

use etendue_image_bits::{ImageHashes, REPLACE, TABLE, differences, rows, scenes, text, write};

/// Where a product and a sum are rounded twice, or a processor has no vectors of 8, images are others.
#[cfg_attr(not(target_feature = "fma"), ignore = "products and sums of this build are rounded twice")]
#[test]
fn every_image_has_the_bits_of_the_table() {
    let all: Vec<ImageHashes> = scenes().iter().flat_map(|scene| rows(scene)).collect();
    let differences = differences(&all, &scenes(), TABLE);
    assert!(
        differences.is_empty(),
        "{}\nIf these images are meant to change, `{REPLACE}` replaces the table, and says why in its changelog.",
        differences.join("\n")
    );
}

#[test]
fn every_difference_is_named() {
    let row = |name: &str, hashes: &[u64]| ImageHashes { name: name.to_owned(), hashes: hashes.to_vec() };
    let rows = [row("a/area", &[1, 2, 3]), row("a/auto/error", &[4])];
    let table = text(&rows) + "b/area 0000000000000001\n";
    assert!(table.starts_with("a/area 0000000000000001 0000000000000002 0000000000000003\n"));
    assert_eq!(differences(&rows, &["a"], &table), [""; 0]);
    let changed = [row("a/area", &[1, 2, 5]), row("a/auto/error", &[6]), row("a/brdf", &[1])];
    let expected = [
        "a/area: adaptive differs from the table",
        "a/auto/error: its image differs from the table",
        "a/brdf: not in the table",
        "b/area 0000000000000001: no such image",
    ];
    assert_eq!(differences(&changed, &["a", "b"], &table), expected);
    assert_eq!(
        differences(&[row("b/area", &[1, 2])], &["b"], &table),
        ["b/area: another number of images than in the table"]
    );
}

#[test]
fn the_table_is_not_replaced_without_a_reason() {
    assert!(write(&[], " ").is_err() && write(&[], "two\nlines").is_err());
}
