//! What a scene holds, one line for each thing.

use crate::limit;
use hyaline_math::{DVec3, Transform};
use hyaline_scene::{
    Absorption, BoundaryDescription, CameraDescription, FileIntegrator, FilmDescription, IndexDescription,
    LightDescription, LightKind, MaterialDescription, MaterialKind, MediumDescription, Metal,
    ObjectDescription, PixelFilter, Projection, SceneDescription, Settings, ShapeDescription,
    TextureDescription, TextureKind,
};
use hyaline_transport::integrator;

/// All lines, in the order: film, settings, cameras, media, materials, textures, objects, lights.
pub(crate) fn lines(scene: &SceneDescription) -> Vec<String> {
    let mut lines = vec![film(&scene.film), settings(&scene.settings)];
    lines.extend(
        scene.settings.file_integrator.as_ref().map(|file| format!("file asks  {}", file_integrator(file))),
    );
    lines.extend(scene.cameras.iter().map(|item| camera(item)));
    lines.extend(scene.surrounding.as_ref().map(|name| format!("world      filled with '{}'", name.value)));
    lines.extend(scene.media.iter().map(|item| medium(item)));
    lines.extend(scene.materials.iter().map(|item| material(item)));
    lines.extend(scene.textures.iter().map(|item| texture(item)));
    lines.extend(scene.objects.iter().map(|item| object(item)));
    lines.extend(scene.lights.iter().map(|item| light(item)));
    lines
}

fn film(film: &FilmDescription) -> String {
    let filter = match film.filter {
        PixelFilter::Box => "box".to_owned(),
        PixelFilter::Tent(radius) => format!("tent of radius {radius}"),
        PixelFilter::Gaussian { sigma, radius } => format!("Gaussian of sigma {sigma}, radius {radius}"),
    };
    let crop = film.crop.map_or_else(String::new, |[x0, y0, x1, y1]| format!(", crop {x0},{y0},{x1},{y1}"));
    format!("film       {} x {} pixels, {filter} filter{crop}", film.width, film.height)
}

fn settings(settings: &Settings) -> String {
    let integrator = match &settings.integrator {
        Some(name) => name.clone(),
        None => format!("{} (default)", integrator::NAMES[0]),
    };
    let passes = match settings.passes {
        Some(passes) => passes.to_string(),
        None => format!("{} (default)", limit::DEFAULT_PASSES),
    };
    let sampler = format!("{:?}", settings.sampler).to_lowercase();
    format!("settings   {integrator}, {passes} passes, seed {}, {sampler} samples", settings.seed)
}

/// What an imported file asks of its own renderer.
pub(crate) fn file_integrator(file: &FileIntegrator) -> String {
    let depth = file.max_depth.map_or_else(String::new, |depth| format!(", depth {depth}"));
    let spp = file.spp.map_or_else(String::new, |spp| format!(", {spp} samples per pixel"));
    format!("{}{depth}{spp} (obeyed with --as-file only)", file.name)
}

fn camera(camera: &CameraDescription) -> String {
    let projection = match camera.projection {
        Projection::Perspective { fov, .. } => format!("perspective, {:.1} degrees", fov.to_degrees()),
        Projection::ThinLens { fov, lens_radius, focus_distance, .. } => format!(
            "thin lens, {:.1} degrees, radius {lens_radius}, focus at {focus_distance}",
            fov.to_degrees()
        ),
        Projection::Orthographic { height } => format!("orthographic, height {height}"),
        Projection::Fisheye { fov } => format!("fisheye, {:.1} degrees", fov.to_degrees()),
        Projection::Spherical { .. } => "spherical".to_owned(),
    };
    let place = camera.placement.translation();
    format!("camera     '{}': {projection}, at {}", camera.name, point(place))
}

fn medium(medium: &MediumDescription) -> String {
    let index = match &medium.index {
        IndexDescription::Constant(index) => format!("index {index}"),
        IndexDescription::Named(name) => format!("index of {}", name.value),
        IndexDescription::Abbe { nd, abbe } => format!("index {nd}, Abbe number {abbe}"),
        IndexDescription::Cauchy { .. } => "index by Cauchy's formula".to_owned(),
        IndexDescription::Sellmeier { .. } => "index by Sellmeier's formula".to_owned(),
    };
    let absorption = match medium.absorption {
        Absorption::None => "clear".to_owned(),
        Absorption::Filter(color) => format!("filters by {color:?} per unit"),
        Absorption::SigmaA(sigma_a) => format!("absorbs {sigma_a:?} per unit"),
        Absorption::ColorAt { color, distance } => format!("color {color:?} at {distance}"),
    };
    let scattering = match &medium.scattering {
        Some(scattering) => {
            format!(
                ", scatters {:?} per unit with mean cosine {}",
                scattering.sigma_s,
                scattering.phase.mean_cosine()
            )
        }
        None => String::new(),
    };
    format!("medium     '{}': {index}, {absorption}{scattering}, priority {}", medium.name, medium.priority)
}

fn material(material: &MaterialDescription) -> String {
    let kind = match &material.kind {
        MaterialKind::Matte { .. } => "matte".to_owned(),
        MaterialKind::Phong { .. } => "Phong".to_owned(),
        MaterialKind::PerfectSpecular { .. } => "perfect specular".to_owned(),
        MaterialKind::Conductor { metal: Metal::Named(name), .. } => name.value.clone(),
        MaterialKind::Conductor { .. } => "metal".to_owned(),
        MaterialKind::GlossySpecular { .. } => "glossy specular".to_owned(),
        MaterialKind::SimpleTransparent { k_r, k_t, .. } => {
            format!("simple transparent, k_r {k_r}, k_t {k_t}")
        }
        MaterialKind::Dielectric { .. } => "dielectric".to_owned(),
        MaterialKind::ThinDielectric { ior, .. } => format!("thin dielectric, index {ior}"),
        MaterialKind::Plastic { ior, .. } => format!("plastic, index {ior}"),
        MaterialKind::Blend { first, second, .. } => {
            format!("blend of '{}' and '{}'", first.value, second.value)
        }
        MaterialKind::PassThrough => "pass-through".to_owned(),
        MaterialKind::Black => "black".to_owned(),
    };
    format!("material   '{}': {kind}", material.name)
}

fn texture(texture: &TextureDescription) -> String {
    let kind = match &texture.kind {
        TextureKind::Image(image) => format!("image of {} x {} pixels", image.width, image.height),
        TextureKind::Checker { .. } => "checker".to_owned(),
    };
    format!("texture    '{}': {kind}", texture.name)
}

fn object(object: &ObjectDescription) -> String {
    let boundary = match &object.boundary {
        BoundaryDescription::None => String::new(),
        BoundaryDescription::Solid { medium } => format!(", solid of '{}'", medium.value),
        BoundaryDescription::Interface { outside, inside } => {
            let name = |side: &Option<hyaline_scene::Located<String>>| {
                side.as_ref()
                    .map_or_else(|| "the world's medium".to_owned(), |name| format!("'{}'", name.value))
            };
            format!(", interface of {} outside and {} inside", name(outside), name(inside))
        }
    };
    let emission = object.emission.as_ref().map_or_else(String::new, |emission| {
        format!(", shines with {:?} ({:?})", emission.color, emission.quantity).to_lowercase()
    });
    let word = if object.emission.is_some() { "light " } else { "object" };
    let (form, scale) = (shape(&object.shape), scale(&object.placement));
    let finish = &object.material.value;
    format!("{word}     '{}': {form}{scale}{boundary}, finish '{finish}'{emission}", object.name)
}

/// How much a placement enlarges, in words; nothing where it does not.
fn scale(placement: &Transform) -> String {
    let axes = placement.linear();
    let lengths = [axes.x_axis.length(), axes.y_axis.length(), axes.z_axis.length()];
    if lengths.iter().all(|length| (length - 1.0).abs() < 1e-6) {
        return String::new();
    }
    let [x, y, z] =
        lengths.map(|length| format!("{length:.4}").trim_end_matches('0').trim_end_matches('.').to_owned());
    if x == y && y == z { format!(" scaled by {x}") } else { format!(" scaled by {x}, {y}, {z}") }
}

fn shape(shape: &ShapeDescription) -> String {
    match shape {
        ShapeDescription::Sphere { radius, .. } => format!("sphere of radius {radius}"),
        ShapeDescription::Disc { radius, inner_radius, .. } if *inner_radius > 0.0 => {
            format!("annulus of radii {inner_radius} and {radius}")
        }
        ShapeDescription::Disc { radius, .. } => format!("disc of radius {radius}"),
        ShapeDescription::Rectangle { half_u, half_v, .. } => {
            format!("rectangle of {} x {}", 2.0 * half_u.length(), 2.0 * half_v.length())
        }
        ShapeDescription::Box { min, max, .. } => format!("box from {} to {}", point(*min), point(*max)),
        ShapeDescription::Cylinder { radius, y, .. } => {
            format!("cylinder of radius {radius}, height {}", y[1] - y[0])
        }
        ShapeDescription::Cone { radius, height, .. } => format!("cone of radius {radius}, height {height}"),
        ShapeDescription::Torus { major_radius, minor_radius, .. } => {
            format!("torus of radii {major_radius} and {minor_radius}")
        }
        ShapeDescription::Mesh { mesh, .. } => format!("mesh of {} triangles", mesh.triangles.len()),
        ShapeDescription::Generated { form, triangles } => {
            format!("generated {} of about {triangles} triangles", format!("{form:?}").to_lowercase())
        }
        ShapeDescription::Revolution { profile, .. } => format!("revolution of {} points", profile.len()),
        ShapeDescription::Compound { parts } => format!("compound of {} parts", parts.len()),
        ShapeDescription::Instance { of } => format!("instance of '{}'", of.value),
        ShapeDescription::Vessel(vessel) => {
            let fill: Vec<String> =
                vessel.fill.iter().map(|layer| format!("'{}'", layer.medium.value)).collect();
            let fill = if fill.is_empty() { "empty".to_owned() } else { format!("with {}", fill.join(", ")) };
            format!("vessel of '{}', {fill}", vessel.medium.value)
        }
    }
}

fn light(light: &LightDescription) -> String {
    let kind = match &light.kind {
        LightKind::Point { position, intensity } => {
            format!("point at {}, {intensity:?} W/sr", point(*position))
        }
        LightKind::Spot { position, outer_angle, intensity, .. } => format!(
            "spot at {}, half-angle {:.1} degrees, {intensity:?} W/sr",
            point(*position),
            outer_angle.to_degrees()
        ),
        LightKind::Projector { placement, fov, .. } => {
            format!("projector at {}, {:.1} degrees across", point(placement.translation()), fov.to_degrees())
        }
        LightKind::Directional { direction, irradiance } => {
            format!("directional along {}, {irradiance:?} W/m2", point(*direction))
        }
        LightKind::Environment { radiance, image, .. } => match image {
            Some(image) => format!("environment '{}', factor {radiance:?}", image.value),
            None => format!("environment, radiance {radiance:?}"),
        },
        LightKind::Ambient { radiance } => format!("ambient, radiance {radiance:?} (whitted only)"),
    };
    format!("light      '{}': {kind}", light.name)
}

fn point(p: DVec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}
