// Lets the wind blow through a scene that was exported with --wind on, in three.js: what docs/files.md explains.
//   const wind = { time: { value: 0 }, force: { value: new THREE.Vector3(0.5, 0, 0) } };
//   blow(gltf.scene, wind);                    // once; then set wind.time.value (seconds) before each frame
// force: where it blows to; length 1 is a strong wind, as which wind_m of a tree's extras is told.
import * as THREE from 'three';

const kShader = `
attribute vec4 _wind;                    // way of the tree, way of its limb, flutter of a leaf, phase of the limb
uniform float windTime, windWay;         // seconds; metres: the tree's wind_m
uniform vec3 windForce;
vec3 blown(vec3 at) {
  float force = length(windForce);
  float gust = 0.6 + 0.4 * sin(0.9 * windTime - 0.12 * dot(at, windForce) / max(force, 1e-4));  // runs over the site
  float limb = 0.3 * sin(2.5 * windTime + 6.2832 * _wind.w);
  float leaf = 0.04 * force * sin(11.0 * windTime + 40.0 * _wind.w + dot(at, vec3(5.0, 7.0, 6.0)));
  return windWay * (gust * _wind.x + limb * _wind.y) * windForce + leaf * _wind.z * vec3(0.6, 1.0, 0.6);
}
`;

// Moved in world space: the meshes of quantized files have other units.
const kPlace = `
vec4 mvPosition = modelMatrix * vec4(transformed, 1.0);
mvPosition.xyz += blown(mvPosition.xyz);
mvPosition = viewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;
`;

function bend(material, given, way, wind) {
  material.onBeforeCompile = (shader, renderer) => {
    given(shader, renderer);
    Object.assign(shader.uniforms, { windTime: wind.time, windForce: wind.force, windWay: { value: way } });
    shader.vertexShader = kShader + shader.vertexShader.replace('#include <project_vertex>', kPlace);
  };
  return material;
}

export function blow(scene, wind) {
  scene.traverse((mesh) => {
    if (!mesh.isMesh || !mesh.geometry.attributes._wind) return;
    let tree = mesh;
    while (tree.parent && tree.userData.wind_m === undefined) tree = tree.parent;
    const way = tree.userData.wind_m ?? 1, own = mesh.material, plain = () => {};
    mesh.material = bend(own.clone(), own.onBeforeCompile ?? plain, way, wind);
    mesh.customDepthMaterial = bend(
      new THREE.MeshDepthMaterial({ depthPacking: THREE.RGBADepthPacking, map: own.map, alphaTest: own.alphaTest }),
      plain, way, wind);
  });
}
