"""What the panel edits: one group of properties in the scene."""
import bpy

from .presets import PRESETS

PRIORS = [
    ("gmm", "Mixture", "As accurate as the networks, and the fastest"),
    ("ppca", "Gaussian", "One Gaussian of all poses"),
    ("autoencoder", "Autoencoder", ""),
    ("vae", "Variational autoencoder", ""),
    ("none", "None", "The nearest pose, natural or not"),
]


class DepthmocapSettings(bpy.types.PropertyGroup):
    vmc_address: bpy.props.StringProperty(
        name="Address", default="127.0.0.1", description="To listen on; 0.0.0.0 takes streams of other computers too")
    vmc_port: bpy.props.IntProperty(name="Port", default=39539, min=1, max=65535, description="UDP port that --vmc sends to")
    server: bpy.props.StringProperty(
        name="Server", default="http://127.0.0.1:8010", description="Address that depthmocap serve prints")
    prior: bpy.props.EnumProperty(name="Prior", items=PRIORS, description="What says how natural a pose is")
    prior_weight_m: bpy.props.FloatProperty(
        name="Weight", default=0.001, min=0.0, max=0.1, precision=4, step=0.1, subtype="DISTANCE",
        description="How far a joint may stay from its handle for one unit of the prior: more is more natural, less is nearer")
    auto_key: bpy.props.BoolProperty(name="Key every drag", description="Inserts keys at the current frame after each drag")
    preset: bpy.props.EnumProperty(name="Rig", items=[(name, name, "") for name in PRESETS])
    source: bpy.props.PointerProperty(
        name="From", type=bpy.types.Object, poll=lambda _, thing: thing.type == "ARMATURE", description="Armature of depthmocap")
    target: bpy.props.PointerProperty(
        name="To", type=bpy.types.Object, poll=lambda _, thing: thing.type == "ARMATURE", description="Armature of the character")


def register():
    bpy.utils.register_class(DepthmocapSettings)
    bpy.types.Scene.depthmocap = bpy.props.PointerProperty(type=DepthmocapSettings)


def unregister():
    del bpy.types.Scene.depthmocap
    bpy.utils.unregister_class(DepthmocapSettings)
