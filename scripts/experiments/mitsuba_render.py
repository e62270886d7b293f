#!/usr/bin/env python3
"""Renders a scene of ptbench by Mitsuba 3's `path` into a PFM file, box filter. Needs `pip install mitsuba`.

usage: mitsuba_render.py SCENE.json SIZE SPP PATH_LENGTH SEED OUT.pfm [VARIANT [RR_DEPTH]]
                            llvm_ad_rgb, scalar_rgb, ...; roulette from the RR_DEPTHth segment on, else none
"""

import json
import sys

import mitsuba

UNLIMITED = 1_000_000


def rgb(values):
    return {"type": "rgb", "value": values}


def material(given):
    kind = given["type"]
    if kind == "matte":
        return {"bsdf": {"type": "diffuse", "reflectance": rgb(given["albedo"])}}
    if kind == "mirror":
        return {"bsdf": {"type": "conductor", "material": "none", "specular_reflectance": rgb(given["reflectance"])}}
    if kind == "dielectric":
        return {"bsdf": {"type": "dielectric", "int_ior": given["ior"], "ext_ior": 1.0}}
    if kind == "emitter" and "albedo" not in given:
        return {"bsdf": {"type": "diffuse", "reflectance": rgb([0, 0, 0])},
                "emitter": {"type": "area", "radiance": rgb(given["radiance"])}}
    sys.exit(f"error: material type {kind}: Mitsuba's scene would not be the same")


def camera(given, size):
    look = mitsuba.ScalarTransform4f().look_at(origin=given["position"], target=given["look_at"], up=given["up"])
    return {"type": "perspective", "fov": given["fov_deg"], "fov_axis": "x", "to_world": look, "near_clip": 1.0, "far_clip": 1e5,
            "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgb", "component_format": "float32",
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"}}


def scene(given, size, path_length, rr_depth):
    """Lengths count segments here and there."""
    made = {"type": "scene", "sensor": camera(given["camera"], size),
            "integrator": {"type": "path", "max_depth": path_length, "rr_depth": rr_depth}}
    for number, sphere in enumerate(given["spheres"]):
        made[f"sphere_{number}"] = {"type": "sphere", "center": sphere["centre"], "radius": sphere["radius"],
                                    **material(given["materials"][sphere["material"]])}
    return mitsuba.load_dict(made)


def main(path, size, spp, path_length, seed, out, variant="llvm_ad_rgb", rr_depth=UNLIMITED):
    mitsuba.set_variant(variant)
    with open(path, encoding="utf-8") as file:
        made = scene(json.load(file), int(size), int(path_length), int(rr_depth))
    image = mitsuba.render(made, spp=int(spp), seed=int(seed))
    mitsuba.Bitmap(image).write(out)


if __name__ == "__main__":
    if len(sys.argv) not in (7, 8, 9):
        sys.exit(__doc__)
    main(*sys.argv[1:])
