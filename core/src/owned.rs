//! Tables with their memory on the heap, for hosts that have one. Each lends the table that the other modules document.

use crate::discrete::TableError;
use crate::light::{EnvironmentMap, ImageEnvironment, Picture, Region};
use crate::real::Real;
use crate::select::{Join, LightBound, LightTree, LightsError, Node8, TreeAt};
use alloc::vec;
use alloc::vec::Vec;

/// A [`LightTree`] with its memory.
///
/// ```
/// use etendue::{Sphere, owned::OwnedTree, select::LightChoice};
/// let lamp = |x: usize| Sphere::new([x as f32, 0.0, 3.0].into(), 0.1).bound(1.0);
/// let mut tree = OwnedTree::new(&(0..1000).map(lamp).collect::<Vec<_>>(), &())?;
/// let (p, n) = ([500.0, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into());
/// let choice = tree.get().at::<f32>(p, n).choose(0.5);
/// assert!((400..600).contains(&choice.index) && choice.pmf > 0.0);
/// tree.rebuild(&[lamp(1), lamp(2)], &())?;
/// assert_eq!(tree.get().len(), 2);
/// # Ok::<(), etendue::select::LightsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct OwnedTree {
    nodes: Vec<Node8>,
    places: Vec<u32>,
    /// The greatest finite power of a light.
    strongest: f32,
}

impl OwnedTree {
    /// Builds a tree on the threads of `join`; `()` is one thread.
    ///
    /// # Errors
    /// If there are more than [`LightTree::MOST`] lights.
    pub fn new(lights: &[LightBound], join: &impl Join) -> Result<Self, LightsError> {
        let mut tree = Self { nodes: Vec::new(), places: Vec::new(), strongest: 0.0 };
        tree.rebuild(lights, join).map(|()| tree)
    }
    /// Builds another tree in the same memory, which grows where it has to.
    ///
    /// # Errors
    /// If there are more than [`LightTree::MOST`] lights. The tree is then what it was.
    pub fn rebuild(&mut self, lights: &[LightBound], join: &impl Join) -> Result<(), LightsError> {
        if lights.len() > LightTree::MOST {
            return Err(LightsError::TooMany);
        }
        self.nodes.resize(LightTree::nodes_for(lights.len()), Node8::default());
        self.places.resize(lights.len(), 0);
        self.strongest = strongest(lights);
        LightTree::build_with(lights, &mut self.nodes, &mut self.places, join).map(|_| ())
    }
    /// Adapts the tree to lights that have moved: [`LightTree::refit`].
    ///
    /// # Errors
    /// If the number of lights is not that of the tree.
    pub fn refit(&mut self, lights: &[LightBound]) -> Result<(), LightsError> {
        LightTree::refit(lights, &mut self.nodes, &self.places)?;
        self.strongest = strongest(lights);
        Ok(())
    }
    /// Lends the tree.
    #[must_use]
    pub fn get(&self) -> LightTree<'_> {
        LightTree::from_buffers(&self.nodes, &self.places)
    }
    /// An estimate of the irradiance that all lights cause where a choice among them has been prepared: [`TreeAt::irradiance`].
    #[inline]
    pub fn irradiance<R: Real>(&self, at: &TreeAt<'_, R>) -> R {
        at.irradiance(self.strongest)
    }
}

/// The greatest finite power.
fn strongest(lights: &[LightBound]) -> f32 {
    lights.iter().map(|light| light.power).filter(|power| power.is_finite()).fold(0.0, f32::max)
}

/// An [`ImageEnvironment`] with its memory.
#[derive(Clone, Debug)]
pub struct OwnedEnvironment {
    table: Vec<f32>,
    width: usize,
    map: EnvironmentMap,
}

impl OwnedEnvironment {
    /// Builds the table from a weight per steradian for each texel, row by row: [`ImageEnvironment::build`].
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0.
    pub fn new(weights: &[f32], width: usize, map: EnvironmentMap) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        let mut table = vec![0.0; ImageEnvironment::buffer(width, height)];
        ImageEnvironment::build(weights, width, map, &mut table)?;
        Ok(Self { table, width, map })
    }
    /// Copies a table that [`ImageEnvironment::build`] has left.
    ///
    /// # Errors
    /// If its length is not that of a table with so many columns.
    pub fn from_table(table: &[f32], width: usize, map: EnvironmentMap) -> Result<Self, TableError> {
        ImageEnvironment::from_buffer(table, width, map)?;
        Ok(Self { table: table.to_vec(), width, map })
    }
    /// Lends the environment.
    #[must_use]
    pub fn get(&self) -> ImageEnvironment<'_> {
        ImageEnvironment::from_buffer(&self.table, self.width, self.map).expect("the table was built for this size")
    }
}

/// A [`Picture`] with its memory.
///
/// ```
/// use etendue::{LightSampler, Rectangle, Vec2, light::Region, owned::OwnedPicture};
/// let picture = OwnedPicture::new(&[0.0, 0.0, 0.0, 5.0], 2, Region::Square)?;
/// let screen = Rectangle::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
/// let s = picture.get().on(screen).by_solid_angle([0.0; 3].into()).sample(Vec2::new(0.3, 0.6));
/// assert!(s.uv.x > 0.5 && s.uv.y > 0.5);
/// # Ok::<(), etendue::discrete::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct OwnedPicture {
    table: Vec<f32>,
    /// The values between which it is interpolated, if it is.
    values: Option<Vec<f32>>,
    /// Columns and rows of the image.
    size: [usize; 2],
    region: Region,
}

impl OwnedPicture {
    /// Builds the hierarchy from the mean radiance of each texel, row by row: [`Picture::build`].
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0 within the region.
    pub fn new(weights: &[f32], width: usize, region: Region) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        let mut table = vec![0.0; Self::length(width, height)?];
        Picture::build(weights, width, region, &mut table)?;
        Ok(Self { table, values: None, size: [width, height], region })
    }
    /// Builds the hierarchy of a picture that is interpolated between these values: [`Picture::interpolated`].
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn interpolated(values: Vec<f32>, width: usize) -> Result<Self, TableError> {
        let height = values.len().checked_div(width).unwrap_or(0);
        let mut table = vec![0.0; Self::length(width.saturating_add(1), height + 1)?];
        Picture::interpolated(&values, width, &mut table)?;
        Ok(Self { table, values: Some(values), size: [width, height], region: Region::Square })
    }
    /// Returns the length of the table of a picture, which must be neither empty nor too large for one.
    fn length(width: usize, height: usize) -> Result<usize, TableError> {
        let is_size = width.checked_mul(height).is_some_and(|count| (1..=u32::MAX as usize / 2).contains(&count));
        if is_size { Ok(Picture::buffer(width, height)) } else { Err(TableError::Length) }
    }
    /// Lends the picture.
    #[must_use]
    pub fn get(&self) -> Picture<'_> {
        let [width, _] = self.size;
        let picture = match &self.values {
            Some(values) => Picture::interpolated_from_buffer(values, width, &self.table),
            None => Picture::from_buffer(&self.table, self.size, self.region),
        };
        picture.expect("the table was built for this size")
    }
}
