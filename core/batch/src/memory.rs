//! What lights have in memory beside their numbers, by pointers: the views of the core have no layout that is the same in two compilations, so
//! that each level of instructions makes its own from these.

use core::marker::PhantomData;
use core::ptr::null;
use core::slice::from_raw_parts;
use etendue::discrete::TableError;
use etendue::light::{self, EnvironmentMap, ImageEnvironment, Portal, PortalEnvironment, PortalTable, Region};
use etendue::select::{LightTree, Node8};

/// The slices of what follows live as long as its lifetime.
macro_rules! shared {
    ($($name:ident),+) => {
        // SAFETY: it is a shared borrow of numbers
        $(unsafe impl Send for $name<'_> {}
        // SAFETY: as above
        unsafe impl Sync for $name<'_> {})+
    };
}
shared!(PictureMemory, ImageMemory, PortalSums, PortalMemory, TreeMemory);

/// A [`Picture`](light::Picture) in the caller's memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PictureMemory<'a> {
    table: *const f32,
    /// Null unless it is interpolated.
    values: *const f32,
    /// Columns and rows of the image.
    size: [usize; 2],
    region: u32,
    lives: PhantomData<&'a [f32]>,
}

impl<'a> PictureMemory<'a> {
    /// The picture that [`build`](light::Picture::build) has left in a buffer.
    ///
    /// # Errors
    /// If the length of the buffer is not that of such a picture.
    pub fn new(table: &'a [f32], size: [usize; 2], region: Region) -> Result<Self, TableError> {
        let _ = light::Picture::from_buffer(table, size, region)?;
        Ok(Self { table: table.as_ptr(), values: null(), size, region: region as u32, lives: PhantomData })
    }
    /// The picture that [`interpolated`](light::Picture::interpolated) has left in a buffer.
    ///
    /// # Errors
    /// If the lengths are not those of such a picture.
    pub fn interpolated(values: &'a [f32], width: usize, table: &'a [f32]) -> Result<Self, TableError> {
        let _ = light::Picture::interpolated_from_buffer(values, width, table)?;
        let size = [width, values.len() / width];
        Ok(Self { table: table.as_ptr(), values: values.as_ptr(), size, region: 0, lives: PhantomData })
    }
    /// The picture; none if a number of the struct is wrong.
    #[inline(always)]
    pub fn view(&self) -> Option<light::Picture<'a>> {
        let region = match self.region {
            0 => Region::Square,
            1 => Region::Triangle,
            2 => Region::Disk,
            _ => return None,
        };
        let [width, height] = self.size;
        let more = usize::from(!self.values.is_null());
        let [columns, rows] = [width.checked_add(more)?, height.checked_add(more)?];
        let is_size = |n: usize| (1..=1 << 24).contains(&n);
        if self.table.is_null() || width == 0 || height == 0 || !is_size(columns) || !is_size(rows) {
            return None;
        }
        if columns > u32::MAX as usize / 2 / rows {
            return None;
        }
        // SAFETY: the memory of a picture of this size
        unsafe {
            let table = from_raw_parts(self.table, light::Picture::buffer(columns, rows));
            if self.values.is_null() {
                light::Picture::from_buffer(table, self.size, region).ok()
            } else {
                let values = from_raw_parts(self.values, width * height);
                light::Picture::interpolated_from_buffer(values, width, table).ok()
            }
        }
    }
}

/// An [`ImageEnvironment`] in the caller's memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ImageMemory<'a> {
    table: *const f32,
    size: [usize; 2],
    map: u32,
    lives: PhantomData<&'a [f32]>,
}

impl<'a> ImageMemory<'a> {
    /// The environment that [`build`](ImageEnvironment::build) has left in a buffer.
    ///
    /// # Errors
    /// If the length of the buffer is not that of an image with so many columns.
    pub fn new(table: &'a [f32], width: usize, map: EnvironmentMap) -> Result<Self, TableError> {
        let size = ImageEnvironment::from_buffer(table, width, map)?.size();
        Ok(Self { table: table.as_ptr(), size, map: map as u32, lives: PhantomData })
    }
    /// The environment; none if a number of the struct is wrong.
    #[inline(always)]
    pub fn view(&self) -> Option<ImageEnvironment<'a>> {
        let map = match self.map {
            0 => EnvironmentMap::EqualArea,
            1 => EnvironmentMap::Equirectangular,
            _ => return None,
        };
        let [width, height] = self.size;
        let is_size = |n: usize| (1..=1 << 24).contains(&n);
        if self.table.is_null() || !is_size(width) || !is_size(height) {
            return None;
        }
        let length = (width + 1).checked_mul(height)?;
        // SAFETY: the memory of an image of this size
        ImageEnvironment::from_buffer(unsafe { from_raw_parts(self.table, length) }, width, map).ok()
    }
}

/// A parallelogram through which the sky is seen: the arguments of [`Portal::new`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct PortalShape {
    /// A corner, in the coordinates of the scene.
    pub corner: [f32; 3],
    /// An edge from there.
    pub edge_s: [f32; 3],
    /// The other edge.
    pub edge_t: [f32; 3],
}

impl PortalShape {
    /// The portal; none if its edges are parallel or a number is not finite.
    #[inline(always)]
    pub fn view(&self) -> Option<Portal> {
        Portal::new(self.corner, self.edge_s, self.edge_t).ok()
    }
}

/// A [`PortalTable`] in the caller's memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PortalSums<'a> {
    sums: *const u64,
    size: [usize; 2],
    lives: PhantomData<&'a [u64]>,
}

impl<'a> PortalSums<'a> {
    /// The table that [`build`](PortalTable::build) has left in a buffer.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a table with so many columns.
    pub fn new(sums: &'a [u64], width: usize) -> Result<Self, TableError> {
        let size = PortalTable::from_buffer(sums, width)?.size();
        Ok(Self { sums: sums.as_ptr(), size, lives: PhantomData })
    }
    /// The table; none if a number of the struct is wrong.
    #[inline(always)]
    pub fn view(&self) -> Option<PortalTable<'a>> {
        let [width, height] = self.size;
        let is_size = |n: usize| (1..=4096).contains(&n);
        if self.sums.is_null() || !is_size(width) || !is_size(height) {
            return None;
        }
        // SAFETY: the memory of a table of this size
        PortalTable::from_buffer(unsafe { from_raw_parts(self.sums, PortalTable::buffer(width, height)) }, width).ok()
    }
}

/// A [`PortalEnvironment`] in the caller's memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PortalMemory<'a> {
    portals: *const PortalShape,
    tables: *const PortalSums<'a>,
    count: usize,
    lives: PhantomData<&'a [PortalSums<'a>]>,
}

impl<'a> PortalMemory<'a> {
    /// The sky through these portals, with the table of each. None if there are none, more than [`MOST`](PortalEnvironment::MOST) or not as many tables, or if
    /// the edges of a portal are parallel or not finite.
    pub fn new(portals: &'a [PortalShape], tables: &'a [PortalSums<'a>]) -> Option<Self> {
        let count = portals.len();
        let this = Self { portals: portals.as_ptr(), tables: tables.as_ptr(), count, lives: PhantomData };
        (tables.len() == count && this.with(|_| ()).is_some()).then_some(this)
    }
    /// Calls `f` with the environment, unless a number of the struct is wrong.
    #[inline(always)]
    pub fn with<T>(&self, f: impl FnOnce(PortalEnvironment<'_>) -> T) -> Option<T> {
        if self.portals.is_null() || self.tables.is_null() || !(1..=PortalEnvironment::MOST).contains(&self.count) {
            return None;
        }
        // SAFETY: the memory has so many of them
        let (shapes, sums) =
            unsafe { (from_raw_parts(self.portals, self.count), from_raw_parts(self.tables, self.count)) };
        let first = (shapes[0].view()?, sums[0].view()?);
        let (mut portals, mut tables) = ([first.0; PortalEnvironment::MOST], [first.1; PortalEnvironment::MOST]);
        for (i, (shape, sums)) in shapes.iter().zip(sums).enumerate() {
            (portals[i], tables[i]) = (shape.view()?, sums.view()?);
        }
        PortalEnvironment::new(&portals[..self.count], &tables[..self.count]).ok().map(f)
    }
}

/// A [`LightTree`] in the caller's memory.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TreeMemory<'a> {
    nodes: *const Node8,
    node_count: usize,
    places: *const u32,
    light_count: usize,
    lives: PhantomData<&'a [Node8]>,
}

impl<'a> TreeMemory<'a> {
    /// The tree that [`build`](LightTree::build) has left in this memory.
    #[must_use]
    pub fn new(nodes: &'a [Node8], places: &'a [u32]) -> Self {
        let (node_count, light_count) = (nodes.len(), places.len());
        Self { nodes: nodes.as_ptr(), node_count, places: places.as_ptr(), light_count, lives: PhantomData }
    }
    /// The tree; none if a pointer is null.
    #[inline(always)]
    pub fn view(&self) -> Option<LightTree<'a>> {
        let is_some = !self.nodes.is_null() && !self.places.is_null();
        // SAFETY: the memory of a tree
        is_some.then(|| unsafe {
            let nodes = from_raw_parts(self.nodes, self.node_count);
            LightTree::from_buffers(nodes, from_raw_parts(self.places, self.light_count))
        })
    }
}
