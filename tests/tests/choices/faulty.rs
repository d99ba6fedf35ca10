//! What no table can be built of.

use TableError::{Empty, Length, Weight};
use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d, TableError};
use etendue::light::{EnvironmentMap, ImageEnvironment, Picture, PortalTable, Region};
use etendue::owned::{OwnedEnvironment, OwnedPicture};

/// What builds a table of so many columns in memory for two rows and two columns.
type Builds = fn(&[f32], usize) -> Option<TableError>;

#[test]
fn faulty_images_are_errors() {
    const MAP: EnvironmentMap = EnvironmentMap::EqualArea;
    let builds: [(&str, Builds); 8] = [
        ("line", |weights, width| PiecewiseConstant1d::build(weights, &mut vec![0.0; 2 * width.min(9)]).err()),
        ("table", |weights, width| PiecewiseConstant2d::build(weights, width, &mut [0.0; 6]).err()),
        ("environment", |weights, width| ImageEnvironment::build(weights, width, MAP, &mut [0.0; 6]).err()),
        ("picture", |weights, width| {
            Picture::build(weights, width, Region::Square, &mut [0.0; Picture::buffer(2, 2)]).err()
        }),
        ("portal", |weights, width| PortalTable::build(weights, width, &mut [0; PortalTable::buffer(2, 2)]).err()),
        ("owned environment", |weights, width| OwnedEnvironment::new(weights, width, MAP).err()),
        ("owned picture", |weights, width| OwnedPicture::new(weights, width, Region::Square).err()),
        ("interpolated", |weights, width| OwnedPicture::interpolated(weights.to_vec(), width).err()),
    ];
    let faulty = [
        (&[][..], 2, Length),
        (&[1.0; 4], 0, Length),
        (&[1.0; 4], 3, Length),
        (&[1.0; 4], usize::MAX, Length),
        (&[1.0; 5], 2, Length),
        (&[0.0; 4], 2, Empty),
        (&[1.0, -1.0, 1.0, 1.0], 2, Weight),
        (&[1.0, f32::NAN, 1.0, 1.0], 2, Weight),
        (&[1.0, f32::INFINITY, 1.0, 1.0], 2, Weight),
    ];
    for (name, build) in builds {
        for (weights, width, error) in faulty {
            assert_eq!(build(weights, width), Some(error), "{name}: {weights:?}, {width} columns");
        }
        assert_eq!(build(&[1.0; 4], 2), None, "{name}");
    }
    // in memory for another size
    for (texels, memory) in [(6, 6), (4, 9), (4, 8), (4, 3)] {
        let weights = &[1.0; 6][..texels];
        assert_eq!(PiecewiseConstant2d::build(weights, 2, &mut vec![0.0; memory]).err(), Some(Length), "{memory}");
    }
    assert_eq!(Picture::build(&[1.0; 25], 5, Region::Square, &mut [0.0; Picture::buffer(2, 2)]).err(), Some(Length));
    assert_eq!(PortalTable::build(&[1.0; 6], 2, &mut [0; PortalTable::buffer(2, 2)]).err(), Some(Length));
}

/// Buffers have the length that their size asks for.
#[test]
fn buffers_of_other_sizes_are_errors() {
    for (length, width) in [(5, 2), (6, 0), (0, 3), (6, usize::MAX)] {
        assert!(ImageEnvironment::from_buffer(&[0.0; 6][..length], width, EnvironmentMap::EqualArea).is_err());
    }
    for (length, width) in [(9, 2), (10, 0), (0, 3), (10, usize::MAX), (1, 1)] {
        assert!(PortalTable::from_buffer(&[0; 10][..length], width).is_err(), "{length} {width}");
    }
    // all of it is beyond the diagonal
    let mut corner = [0.0; 16];
    corner[15] = 1.0;
    let mut buffer = [0.0; Picture::buffer(4, 4)];
    assert_eq!(Picture::build(&corner, 4, Region::Triangle, &mut buffer).err(), Some(Empty));
    assert!(Picture::build(&corner, 4, Region::Square, &mut buffer).is_ok());
    assert!(Picture::from_buffer(&buffer, [4, 4], Region::Square).is_ok());
    for size in [[4, 5], [0, 4], [1, 1], [1 << 25, 1]] {
        assert_eq!(Picture::from_buffer(&buffer, size, Region::Square).err(), Some(Length));
    }
    for [w, h] in [[1, 1], [2, 1], [1, 5], [1, 1000], [17, 5], [1024, 1024], [1025, 3]] {
        let length = Picture::buffer(w, h);
        assert!(length + 1 >= w * h && length < 13 * w * h, "{w} × {h}: {length}");
    }
    assert_eq!(Picture::buffer(1024, 1024), 16 * (1024 * 1024 - 1) / 15);
}
