//! A light of its own for each lane of a packet, prepared and used in one call.

use crate::columns::{EvaluationColumns, Evaluations, SampleColumns};
use crate::functions::TechniqueFunctions;
use crate::kernel::Views;
use crate::level::Batch;
use crate::packet::Packet;
use crate::technique::Technique;
use core::mem::MaybeUninit;
use core::ptr::from_ref;
use etendue::{Mask, Vec2, Vec3};

/// The most numbers of a light, of a point and of what else it is prepared for.
const MOST_NUMBERS: usize = 64;
/// The lanes of the widest packet, `f32x16`.
const MOST_LANES: usize = 16;
/// How many numbers a sample has.
const NUMBERS: usize = 11;

/// What the lanes of a packet have drawn or hit. The fields are those of [`etendue::LightSample`].
#[derive(Clone, Copy, Debug)]
pub struct PacketSample<R: Packet> {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3<R>,
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: R,
    /// Probability density of the direction, per steradian (lines: see [`etendue::Line`]); 0 where there is no sample.
    pub pdf: R,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: R,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: Vec3<R>,
    /// Surface coordinates of the sampled point in [0, 1]². Not meaningful where the pdf is 0.
    pub uv: Vec2<R>,
    /// True where the shading point is on the side of the light that emits.
    pub emits: R::Mask,
}

/// Calls `f` with lights, points and what they are prepared for, of which each packet is a column.
fn with_views<T: Technique, R: Packet>(light: T::Light<R>, p: Vec3<R>, with: T::With<R>, f: impl FnOnce(&Views)) {
    let mut numbers = [const { MaybeUninit::<R>::uninit() }; MOST_NUMBERS];
    let (first, mut count) = (numbers.as_mut_ptr().cast::<R>(), 0);
    let mut column = |packet: R| {
        assert!(count < MOST_NUMBERS, "no light has so many numbers");
        // SAFETY: there is room for it
        let place = unsafe { first.add(count) };
        // SAFETY: as above
        unsafe { place.write(packet) };
        count += 1;
        place.cast::<f32>().cast_const()
    };
    let (lights, with) = (T::map_light(light, &mut column), T::map_with(with, &mut column));
    f(&Views { lights: from_ref(&lights).cast(), points: p.map(column), with: from_ref(&with).cast() });
}

/// What `f` writes to columns of as many elements as a packet has lanes.
fn written<R: Packet>(f: impl FnOnce(&SampleColumns)) -> PacketSample<R> {
    let (mut numbers, mut truths) = ([R::default(); NUMBERS], [0_u8; MOST_LANES]);
    let first = numbers.as_mut_ptr();
    let column = |k: usize| first.wrapping_add(k).cast::<f32>();
    f(&SampleColumns {
        direction: [column(0), column(1), column(2)],
        distance: column(3),
        pdf: column(4),
        weight: column(5),
        normal: [column(6), column(7), column(8)],
        uv: [column(9), column(10)],
        emits: truths.as_mut_ptr(),
    });
    let [x, y, z, distance, pdf, weight, nx, ny, nz, s, t] = numbers;
    let bits = (0..R::LANES).map(|lane| u32::from(truths[lane]) << lane).sum();
    PacketSample {
        direction: Vec3::new(x, y, z),
        distance,
        pdf,
        weight,
        normal: Vec3::new(nx, ny, nz),
        uv: Vec2::new(s, t),
        emits: R::Mask::from_bits(bits),
    }
}

impl Batch {
    /// The functions whose packets are not much wider than `R`.
    #[track_caller]
    fn lanes<T: Technique, R: Packet>(&self) -> &'static TechniqueFunctions {
        // the functions of one element are beside those of packets of at most eight lanes
        let of = if R::LANES > 8 { Self::technique } else { Self::technique_to_prepare };
        of(self, T::INDEX)
            .filter(|_| cfg!(feature = "each"))
            .expect("the light is not built: see the features of etendue-batch")
    }
    /// Prepares a light of its own for each lane, for the point `p` and what else the technique takes, and draws one direction from it, for
    /// `u` in [0, 1)². See [Debug builds](crate#debug-builds).
    #[must_use]
    pub fn sample_packet<T: Technique, R: Packet>(
        &self,
        light: T::Light<R>,
        p: Vec3<R>,
        with: T::With<R>,
        u: Vec2<R>,
    ) -> PacketSample<R> {
        let functions = self.lanes::<T, R>();
        let u = Vec2::new(&u.x, &u.y).map(|packet| from_ref(packet).cast());
        written(|out| {
            // SAFETY: a packet is a column of its lanes, and there is room for the results of all of them
            with_views::<T, R>(light, p, with, |views| unsafe {
                (functions.sample_each)(views, R::LANES, u, out);
            });
        })
    }
    /// Prepares a light of its own for each lane, as [`sample_packet`](Self::sample_packet) does, and returns the pdf of the unit direction `w`,
    /// per steradian (lines: see [`etendue::Line`]); 0 where it misses the light.
    #[must_use]
    pub fn pdf_packet<T: Technique, R: Packet>(
        &self,
        light: T::Light<R>,
        p: Vec3<R>,
        with: T::With<R>,
        w: Vec3<R>,
    ) -> R {
        let mut pdf = R::default();
        let nothing = Evaluations::default().columns(R::LANES);
        self.evaluate_packet::<T, R>(light, p, with, w, &EvaluationColumns { pdf: (&raw mut pdf).cast(), ..nothing });
        pdf
    }
    /// Prepares a light of its own for each lane, as [`sample_packet`](Self::sample_packet) does, and returns its nearest point in the unit
    /// direction `w`, with its pdf; 0 where the direction misses it.
    #[must_use]
    pub fn hit_packet<T: Technique, R: Packet>(
        &self,
        light: T::Light<R>,
        p: Vec3<R>,
        with: T::With<R>,
        w: Vec3<R>,
    ) -> PacketSample<R> {
        let nothing = Evaluations::default().columns(R::LANES);
        written(|hit| self.evaluate_packet::<T, R>(light, p, with, w, &EvaluationColumns { hit: *hit, ..nothing }))
    }
    #[track_caller]
    fn evaluate_packet<T: Technique, R: Packet>(
        &self,
        light: T::Light<R>,
        p: Vec3<R>,
        with: T::With<R>,
        w: Vec3<R>,
        out: &EvaluationColumns,
    ) {
        let functions = self.lanes::<T, R>();
        let w = Vec3::new(&w.x, &w.y, &w.z).map(|packet| from_ref(packet).cast());
        // SAFETY: a packet is a column of its lanes, and there is room for the results of all of them
        with_views::<T, R>(light, p, with, |views| unsafe { (functions.evaluate_each)(views, R::LANES, w, out) });
    }
}
