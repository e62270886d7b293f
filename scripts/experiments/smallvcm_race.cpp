// SmallVCM's bidirectional path tracer (`-a bpt`) on a scene that smallvcm_race.py tells: its sources as they
// are, with a light in the shape of a ball, which they do not have. usage: smallvcm_race SIZE PATH_LENGTH SPP
// SEED THREADS FILE.pfm < SCENE
#define main smallvcm_main
#include "smallvcm.cxx"
#undef main

#include <cstdlib>
#include <iostream>

namespace {

/// Asked and left by area, like its AreaLight.
class BallLight : public AbstractLight {
  public:
    BallLight(const Vec3f& centre, float radius, const Vec3f& radiance)
        : centre_(centre), radius_(radius), radiance_(radiance), density_(1 / (4 * PI_F * radius * radius)) {}

    Vec3f Illuminate(const SceneSphere&, const Vec3f& point, const Vec2f& random, Vec3f& direction,
                     float& distance, float& direct_pdf, float* emission_pdf, float* cosine) const {
        const Vec3f normal = SampleUniformSphereW(random, NULL);
        direction = centre_ + normal * Vec3f(radius_) - point;
        const float squared = direction.LenSqr();
        distance = std::sqrt(squared);
        direction = direction / distance;
        const float cos_light = -Dot(normal, direction);
        if (cos_light < EPS_COSINE) return Vec3f(0);
        direct_pdf = density_ * squared / cos_light;
        if (cosine) *cosine = cos_light;
        if (emission_pdf) *emission_pdf = density_ * cos_light * INV_PI_F;
        return radiance_;
    }

    Vec3f Emit(const SceneSphere&, const Vec2f& random_direction, const Vec2f& random_point, Vec3f& point,
               Vec3f& direction, float& emission_pdf, float* direct_pdf, float* cosine) const {
        const Vec3f normal = SampleUniformSphereW(random_point, NULL);
        point = centre_ + normal * Vec3f(radius_);
        Vec3f local = SampleCosHemisphereW(random_direction, &emission_pdf);
        emission_pdf *= density_;
        local.z = std::max(local.z, EPS_COSINE);
        Frame frame;
        frame.SetFromZ(normal);
        direction = frame.ToWorld(local);
        if (direct_pdf) *direct_pdf = density_;
        if (cosine) *cosine = local.z;
        return radiance_ * local.z;
    }

    Vec3f GetRadiance(const SceneSphere&, const Vec3f& direction, const Vec3f& point, float* direct_pdf,
                      float* emission_pdf) const {
        const Vec3f normal = Normalize(point - centre_);
        if (Dot(normal, direction) >= 0) return Vec3f(0);
        if (direct_pdf) *direct_pdf = density_;
        if (emission_pdf) *emission_pdf = CosHemispherePdfW(normal, -direction) * density_;
        return radiance_;
    }

    bool IsFinite() const { return true; }
    bool IsDelta() const { return false; }

  private:
    Vec3f centre_;
    float radius_;
    Vec3f radiance_;
    float density_;
};

Vec3f read_vec() {
    Vec3f v;
    std::cin >> v.x >> v.y >> v.z;
    return v;
}

Material read_material() {
    Material material;
    material.mDiffuseReflectance = read_vec();
    material.mMirrorReflectance = read_vec();
    std::cin >> material.mIOR;
    return material;
}

/// Every shape has a material of its own, as lights need.
void read_scene(Scene& scene, int size) {
    GeometryList* shapes = new GeometryList;
    scene.mGeometry = shapes;
    std::string word;
    while (std::cin >> word) {
        if (word == "camera") {
            const Vec3f position = read_vec(), forward = read_vec(), up = read_vec();
            float fov;
            std::cin >> fov;
            scene.mCamera.Setup(position, forward, up, Vec2f(float(size)), fov);
            continue;
        }
        const int number = static_cast<int>(scene.mMaterials.size());
        scene.mMaterials.push_back(read_material());
        const Vec3f radiance = read_vec();
        AbstractLight* light = NULL;
        if (word == "ball") {
            const Vec3f centre = read_vec();
            float radius;
            std::cin >> radius;
            shapes->mGeometry.push_back(new Sphere(centre, radius, number));
            light = new BallLight(centre, radius, radiance);
        } else {
            const Vec3f a = read_vec(), b = read_vec(), c = read_vec();
            shapes->mGeometry.push_back(new Triangle(a, b, c, number));
            AreaLight* flat = new AreaLight(a, b, c);
            flat->mIntensity = radiance;
            light = flat;
        }
        if (radiance.IsZero()) {
            delete light;
        } else {
            scene.mMaterial2Light[number] = static_cast<int>(scene.mLights.size());
            scene.mLights.push_back(light);
        }
    }
    scene.BuildSceneSphere();
}

}  // namespace

int main(int count, char** words) {
    if (count != 7) return 2;
    Config config;
    const char* no_words[] = {"smallvcm"};
    ParseCommandline(1, no_words, config);
    const int size = std::atoi(words[1]);
    Scene scene;
    read_scene(scene, size);
    config.mScene = &scene;
    config.mAlgorithm = Config::kBidirectionalPathTracing;
    config.mMaxPathLength = static_cast<uint>(std::atoi(words[2]));
    config.mIterations = std::atoi(words[3]);
    config.mBaseSeed = std::atoi(words[4]);
    config.mNumThreads = std::atoi(words[5]);
    Framebuffer picture;
    config.mFramebuffer = &picture;
    render(config);
    picture.SavePFM(words[6]);
}
