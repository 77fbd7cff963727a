//! What a path does at a surface.

use super::merges::{Beyond, Passed, Place};
use super::onward::{Drawn, Onward};
use super::radius::INDIRECT;
use super::reach::Outlook;
use super::weight::{self, Side};
use super::{Draws, Eye, Path, split};
use crate::integrator::merging::{Landed, LandedPhoton, Landing, Photons};
use crate::photon::specular::is_specular;
use crate::shadow;
use crate::walk::Vertex;
use hyaline_math::Vec3;
use hyaline_scattering::{BsdfSample, MediumId, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::{DirectSample, LightChoice};
use hyaline_world::mask;
use std::f32::consts::PI;

impl Eye<'_> {
    /// Gathers, samples a light and scatters; returns whether the path goes on.
    pub(super) fn at_surface(&self, path: &mut Path, vertex: &Vertex, draws: &mut Draws<'_>) -> bool {
        let wo = -path.ray.direction;
        let is_delta = vertex.bsdf.is_delta();
        let is_wide = !is_specular(&vertex.bsdf);
        let aim = self.aim.filter(|_| is_wide).and_then(|aim| aim.at_surface(vertex, wo));
        let beams = self.aim.filter(|_| is_wide).and_then(|aim| aim.onward(vertex, wo));
        let onward = Onward::new(beams);
        if !is_delta && self.may_bounce(path) {
            if let Some(photons) = &self.photons {
                path.seen.light += self.gather(path, vertex, wo, photons, draws);
            }
            path.seen.light += path.throughput * self.sampled_light(path, (vertex, wo), &onward, draws);
            if let Some(cones) = &aim {
                path.seen.light += self.aimed_light(path, (vertex, wo), cones, &onward, draws);
            }
        }
        let (u_lobe, u) = (draws.sampler.next_1d(), draws.sampler.next_2d());
        let Some(Drawn { scattered, thinned }) = onward.sample(vertex, wo, u_lobe, u) else { return false };
        path.index_scale *= thinned;
        self.turn(path, vertex, &scattered);
        if !is_delta {
            // What a coat mirrors is asked for neither here nor from the vertex before.
            let cones = aim.filter(|_| !scattered.is_delta);
            path.rival = cones.map_or(0.0, |cones| cones.pdf(scattered.wi) / scattered.pdf);
        }
        !path.throughput.is_zero() && self.survives(path, draws)
    }

    /// Sends the path on in a direction, and keeps all true that weights go by.
    pub(super) fn turn(&self, path: &mut Path, vertex: &Vertex, scattered: &BsdfSample) {
        path.throughput *= scattered.weight;
        path.index_scale *= scattered.eta_scale;
        let ior_before = self.world.ior(path.set.active());
        if scattered.transmits {
            vertex.commit(self.world, &mut path.set);
        }
        path.last.record(vertex, scattered);
        if scattered.is_delta {
            path.share *= match vertex.bsdf.is_delta() {
                true => split::share(scattered.weight * scattered.pdf, scattered.eta_scale, self.world.lanes),
                // Of a coat, only chance sees what it mirrors.
                false => 0.0,
            };
            path.crossings += 1;
            path.merges.pass_singular();
        } else {
            path.bounces += 1;
            (path.crossings, path.rival, path.share) = (0, 0.0, 0.0);
            self.note_merge(path, vertex, scattered, ior_before);
        }
        path.ray = vertex.leave(scattered.wi, path.ray.time);
        path.visible = mask::PATH;
    }

    /// Keeps the sum over merges true where a direction has been drawn from a lobe that is not singular.
    ///
    /// - `ior_before`: index on the side that the path came from.
    fn note_merge(&self, path: &mut Path, vertex: &Vertex, scattered: &BsdfSample, ior_before: f32) {
        let Some(photons) = &self.photons else { return };
        let ior = self.world.ior(path.set.active());
        let toward_light = side(vertex, scattered.wi, scattered.pdf, ior);
        let radius = photons.radius.on_surface(vertex.hit.p);
        let own = weight::at_receiver(radius, ior, toward_light.cos, scattered.pdf);
        let mut across = 0.0;
        if !path.merges.is_empty() {
            let wo = -path.ray.direction;
            let back = side(vertex, wo, vertex.bsdf.pdf(scattered.wi, wo), ior_before);
            across = weight::across(back, toward_light);
        }
        let is_specular = is_specular(&vertex.bsdf);
        path.merges.pass(&Passed { place: Place::Surface, own, across, is_specular });
    }

    /// Light that the photons about a vertex bring to the picture.
    fn gather(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        photons: &Photons<'_>,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let [caustic, indirect] = self.gathers(path, vertex, wo, photons);
        caustic.light(photons.landed, draws) + indirect.light(photons.landed, draws)
    }

    /// The same photon by photon: those that have come over polished and nearly polished surfaces alone, and others.
    pub(super) fn gathers<'a>(
        &'a self,
        path: &'a Path,
        vertex: &'a Vertex,
        wo: Vec3,
        photons: &Photons<'_>,
    ) -> [Gather<'a>; 2] {
        let radius = photons.radius.on_surface(vertex.hit.p);
        let carried = |radius: f32| path.throughput * (1.0 / (PI * radius * radius));
        let near = path.set.active();
        let far = if vertex.is_boundary() { vertex.far_set(self.world, &path.set).active() } else { near };
        let media = [near, far];
        let caustic = Gather {
            is_indirect: false,
            carried: carried(radius),
            eye: self,
            path,
            vertex,
            wo,
            radius,
            behind: path.merges.behind(beyond(vertex)),
            bounces_left: self.bounces_left(path),
            media,
            iors: media.map(|medium| self.world.ior(medium)),
        };
        let behind = path.merges.behind(Beyond::Wide);
        let wide = radius * INDIRECT;
        [caustic, Gather { is_indirect: true, radius: wide, carried: carried(wide), behind, ..caustic }]
    }

    /// Light of the lights that are asked, by a shadow ray to each.
    fn sampled_light(
        &self,
        path: &Path,
        at: (&Vertex, Vec3),
        onward: &Onward,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let asked = self.asked(path.bounces, draws);
        asked
            .into_iter()
            .fold(Spectrum::ZERO, |sum, choice| sum + self.light_of(choice, path, at, onward, draws))
    }

    fn light_of(
        &self,
        choice: LightChoice,
        path: &Path,
        (vertex, wo): (&Vertex, Vec3),
        onward: &Onward,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let u = draws.sampler.next_2d();
        let Some(sample) = self.world.lights.get(choice.index).sample_direct(vertex.hit.p, u) else {
            return Spectrum::ZERO;
        };
        let (f, of_finish) = vertex.bsdf.eval_with_pdf(wo, sample.wi, Transport::Radiance);
        let pdf = onward.pdf(of_finish, sample.wi);
        let contribution = f * sample.radiance;
        if contribution.is_zero() {
            return contribution;
        }
        let far = crosses(vertex, wo, sample.wi).then(|| vertex.far_set(self.world, &path.set));
        let set = far.as_ref().unwrap_or(&path.set);
        let density = sample.pdf_w * choice.probability;
        let weight = self.sample_weight(path, vertex, wo, pdf, &choice, &sample, set);
        let ray = shadow::ray_to_light(&vertex.hit, &sample, 0.0);
        let way = shadow::straight_way(self.world, &ray, set, draws.stats);
        contribution * (way.shared * weight + way.alone) * (1.0 / density)
    }

    /// What sampling a light counts beside hitting it and merging.
    ///
    /// - `pdf`: density with which the path goes on toward the light, sr⁻¹.
    /// - `set`: what the path to the light is in.
    pub(super) fn sample_weight(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        pdf: f32,
        choice: &LightChoice,
        sample: &DirectSample,
        set: &MediumSet,
    ) -> f32 {
        let techniques = self.settings.techniques;
        let is_hit = techniques.hits && !sample.is_delta;
        let density = sample.pdf_w * choice.probability;
        let hitting = if is_hit { pdf / density } else { 0.0 };
        let merging = self.merging_over_sampling(path, vertex, wo, choice, sample, set);
        weight::share(techniques.sampling, hitting * hitting + merging)
    }

    /// Squared densities of all ways to merge over that of sampling a light.
    ///
    /// - `set`: what the path to the light is in.
    fn merging_over_sampling(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        choice: &LightChoice,
        sample: &DirectSample,
        set: &MediumSet,
    ) -> f32 {
        let Some(photons) = self.photons.as_ref().filter(|_| !path.merges.is_empty()) else { return 0.0 };
        let pdf = choice.probability * sample.pdf_w;
        let toward_light = side(vertex, sample.wi, pdf, self.world.ior(set.active()));
        let back = vertex.bsdf.pdf(sample.wi, wo);
        let toward_receiver = side(vertex, wo, back, self.world.ior(path.set.active()));
        let sender = photons.senders.of(is_specular(&vertex.bsdf));
        let light = sender.density_of_sample(self.world, choice.index, sample, set);
        let factor = weight::across(toward_receiver, toward_light) * light;
        path.merges.behind(beyond(vertex)) * factor * factor
    }
}

/// Photons about a vertex, of one kind.
#[derive(Clone, Copy)]
pub(super) struct Gather<'a> {
    eye: &'a Eye<'a>,
    path: &'a Path,
    vertex: &'a Vertex,
    /// Unit, back along the path.
    wo: Vec3,
    /// Whether they have been scattered widely on their way.
    is_indirect: bool,
    radius: f32,
    /// What the path carries, over the area that is gathered from.
    carried: Spectrum,
    /// Merges at earlier vertices of the path, see `Merges::behind`.
    behind: f32,
    /// Bounces that photons may have made, and one more.
    bounces_left: u32,
    /// Media on the side that the path came from and on the other, and their indices.
    media: [MediumId; 2],
    iors: [f32; 2],
}

impl Gather<'_> {
    /// What they bring to the picture.
    fn light(&self, landed: &Landed, draws: &mut Draws<'_>) -> Spectrum {
        let Self { eye, path, vertex, wo, radius, .. } = *self;
        // Side 0 is that of light which is reflected, 1 that of light which comes through.
        let outlook = |side, rays: &mut u64| {
            let far = (side == 1).then(|| vertex.far_set(eye.world, &path.set));
            let (toward, set) = far.as_ref().map_or((wo, &path.set), |far| (-wo, far));
            Outlook::new(eye.world, vertex, (toward, set), radius, rays)
        };
        let (mut reaches_over, mut is_elsewhere, mut through) = ([false; 2], [None; 2], Spectrum::ZERO);
        let reflected = landed.on_surface(self.is_indirect, vertex.hit.p, radius, |p, photon| {
            let Landing::Surface { n, medium } = photon.landing else { return Spectrum::ZERO };
            if !n.is_one_surface(vertex.hit.ng) {
                reaches_over = [true; 2];
                return Spectrum::ZERO;
            }
            let side = usize::from(crosses(vertex, wo, -photon.direction));
            // Where a mesh has holes, a photon may not know what it is in: one look tells, for all of them.
            if medium != self.media[side]
                && *is_elsewhere[side].get_or_insert_with(|| {
                    !outlook(side, &mut draws.stats.rays).holds(p, &mut draws.stats.rays)
                })
            {
                reaches_over[side] = true;
                return Spectrum::ZERO;
            }
            let light = self.light_of(photon) * self.carried;
            draws.tally.note(photon.id, light);
            // The state of the sum is one of them: more would not stay in registers.
            if side == 1 {
                through += light;
                return Spectrum::ZERO;
            }
            light
        });
        let mut sums = [reflected, through];
        for side in [0, 1] {
            // Where the camera looks, also over edges with nothing beyond them; farther along nobody would see the difference.
            if (reaches_over[side] || path.bounces == 0) && !sums[side].is_zero() {
                sums[side] *= outlook(side, &mut draws.stats.rays).disc_over_part(radius, draws);
            }
        }
        sums[0] + sums[1]
    }

    /// Weighted light of a photon, sent back along the path, times the area it is gathered from.
    fn light_of(&self, photon: &LandedPhoton) -> Spectrum {
        let wi = -photon.direction;
        let (f, pdf) = self.vertex.bsdf.eval_with_pdf(self.wo, wi, Transport::Radiance);
        let cos = wi.dot(self.vertex.hit.ng).abs();
        if f.is_zero() || cos == 0.0 || photon.bounces >= self.bounces_left {
            return Spectrum::ZERO;
        }
        f * photon.flux * (self.weight_of(wi, pdf, photon.others) / cos)
    }

    /// What merging a photon counts beside the other ways to make the path.
    ///
    /// - `wi`: unit, against the photon; `pdf`: its density for the path, sr⁻¹.
    /// - `others`: what the photon's side knows of them.
    pub(super) fn weight_of(&self, wi: Vec3, pdf: f32, mut others: f32) -> f32 {
        let Self { vertex, wo, iors, .. } = *self;
        let ior = iors[usize::from(crosses(vertex, wo, wi))];
        let toward_light = side(vertex, wi, pdf, ior);
        let own = weight::at_receiver(self.radius, ior, toward_light.cos, toward_light.pdf);
        if self.behind > 0.0 {
            let back = side(vertex, wo, vertex.bsdf.pdf(wi, wo), iors[0]);
            let across = weight::across(back, toward_light);
            others += self.behind * across * across;
        }
        weight::power(others / (own * own))
    }
}

/// The way to the light over a vertex, where nothing but polished and nearly polished ones are known to lie beyond it.
fn beyond(vertex: &Vertex) -> Beyond {
    if is_specular(&vertex.bsdf) { Beyond::Polished } else { Beyond::Wide }
}

/// A side of a vertex.
///
/// - `w`: the direction on that side; `pdf`: its density, drawn from the other.
fn side(vertex: &Vertex, w: Vec3, pdf: f32, ior: f32) -> Side {
    Side { pdf, ior, cos: w.dot(vertex.hit.ng).abs() }
}

/// Whether light from `wi` crosses the surface on its way to `wo`.
fn crosses(vertex: &Vertex, wo: Vec3, wi: Vec3) -> bool {
    (wi.dot(vertex.hit.ng) > 0.0) != (wo.dot(vertex.hit.ng) > 0.0)
}
