//! `shapegroup` and `instance`: the shapes of a group placed again and again.
//!
//! Each member of a group is read once. An instance adds one object per member, all of which share the member's
//! mesh, so that they share its hierarchy, too.

use super::element::Element;
use super::importer::Importer;
use super::shape::Built;
use crate::Result;
use hyaline_math::Transform;
use std::collections::BTreeMap;

/// Most objects of a scene: instances can ask for the square of what a file could spell out.
///
/// Tests have a smaller one, which they reach sooner.
const MAX_OBJECTS: usize = if cfg!(test) { 1 << 12 } else { 1 << 20 };

/// The members of groups that were read.
pub(super) type Groups = BTreeMap<usize, Vec<Built>>;

impl Importer<'_> {
    /// Places a group.
    pub(super) fn instance(&mut self, instance: Element<'_>) -> Result<()> {
        let to_world = instance.transform("to_world")?;
        let group = instance.children("shape")?.into_iter().find(|(_, shape)| shape.kind() == "shapegroup");
        let Some((_, group)) = group else {
            let error = instance.error("an instance needs a shapegroup");
            return Err(
                error.with_remedy("add <ref id=\"...\"/> with the id of a shape of type \"shapegroup\"")
            );
        };
        if !self.groups.contains_key(&group.key()) {
            let members = self.members(group)?;
            self.groups.insert(group.key(), members);
        }
        let name = instance.id().or(group.id()).unwrap_or("instance").to_owned();
        // Out of the map while it is used, so that it need not be copied.
        let members = self.groups.remove(&group.key()).unwrap_or_default();
        let placed = members.iter().try_for_each(|member| {
            let built = placed(member, &name, &to_world);
            let Some(built) = built else {
                return Err(instance.error("the transforms of the instance leave the range of numbers"));
            };
            self.add_object(built, instance)
        });
        self.groups.insert(group.key(), members);
        placed
    }

    fn members(&mut self, group: Element<'_>) -> Result<Vec<Built>> {
        let mut members = Vec::new();
        for (_, shape) in group.children("shape")? {
            match shape.kind() {
                "instance" | "shapegroup" | "merge" => {
                    shape.ignore_all();
                    shape.warn(format!("{} within a group is not supported and left out", shape.title()));
                }
                _ => members.extend(self.build(shape)?),
            }
        }
        if members.iter().any(|member| member.object.emission.is_some()) {
            group.info("lamps within a group shine in every instance of it, which Mitsuba refuses");
        }
        Ok(members)
    }

    /// Checks that the scene may have another object.
    pub(super) fn check_room(&self, element: Element<'_>) -> Result<()> {
        if self.scene.objects.len() < MAX_OBJECTS {
            return Ok(());
        }
        Err(element
            .error(format!("the scene has more than {MAX_OBJECTS} objects, instances counted one by one")))
    }
}

/// A member of a group as an object; `None` where its placement is not finite.
fn placed(member: &Built, name: &str, to_world: &Transform) -> Option<Built> {
    let mut built = member.clone();
    built.object.name = format!("{name}/{}", member.object.name);
    built.object.placement = to_world.after(&member.object.placement);
    let (linear, inverse) = (built.object.placement.linear(), built.object.placement.inverse().linear());
    let is_finite = linear.is_finite() && inverse.is_finite();
    (is_finite && built.object.placement.translation().is_finite()).then_some(built)
}
