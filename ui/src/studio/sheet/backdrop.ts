// A picture behind the drawing, kept with it in the browser: the file has no place for it.
import { effect } from "@preact/signals";
import { element } from "../../strokes";
import type { Vec } from "../../shapes";
import type { Bench, Photo } from "../bench";
import type { Camera } from "./camera";

// The longest side of a stored picture, px; its quality.
const LONGEST = 1600, QUALITY = 0.82;
const keyOf = (name: string) => `linkwright.photo.${name}`;

/** A picture that was chosen, made small enough to be stored; as wide as half of the sheet, in its middle. */
export async function taken(file: Blob, camera: Camera): Promise<Photo> {
  const image = await createImageBitmap(file), share = Math.min(1, LONGEST / Math.max(image.width, image.height));
  const canvas = Object.assign(document.createElement("canvas"), { width: Math.round(image.width * share), height: Math.round(image.height * share) });
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  const [w, h] = camera.size, shape = canvas.height / canvas.width, wide = Math.min(0.8 * w, (0.8 * h) / shape);
  const corner = camera.world([(w - wide) / 2, (h - wide * shape) / 2]);
  return { href: canvas.toDataURL("image/jpeg", QUALITY), corner, width: wide / camera.scale, shape, opacity: 0.5, locked: false };
}

/** The same picture so large that two places of it are a length apart; the first one stays where it is. */
export function scaled(photo: Photo, [a, b]: [Vec, Vec], length: number): Photo | null {
  const factor = length / Math.hypot(b[0] - a[0], b[1] - a[1]);
  if (!(factor > 0) || !Number.isFinite(factor)) return null;
  const corner: Vec = [a[0] + factor * (photo.corner[0] - a[0]), a[1] + factor * (photo.corner[1] - a[1])];
  return { ...photo, corner, width: factor * photo.width };
}

/** Keeps the picture of each drawing, and gives it back with the drawing. */
export function keepPhotos(bench: Bench): () => void {
  let open = "";
  return effect(() => {
    const { name } = bench.desk, photo = bench.photo.value;
    if (name.value !== open) {
      open = name.value;
      bench.photo.value = stored(open);
      return;
    }
    try {
      if (photo) localStorage.setItem(keyOf(open), JSON.stringify(photo));
      else localStorage.removeItem(keyOf(open));
    } catch {
      // A browser without room forgets the picture with the page.
    }
  });
}

function stored(name: string): Photo | null {
  try {
    return JSON.parse(localStorage.getItem(keyOf(name)) ?? "null") as Photo | null;
  } catch {
    return null;
  }
}

/** The picture under all else; drawn when the camera or the picture has changed. */
export class Backdrop {
  private image: SVGElement | null = null;

  constructor(private readonly host: Element) {}

  draw(photo: Photo | null, camera: Camera): void {
    if (!photo) {
      this.image?.remove();
      this.image = null;
      return;
    }
    if (!this.image) {
      this.image = element("image", { preserveAspectRatio: "none", class: "photo" });
      this.host.prepend(this.image);
    }
    const [x, y] = camera.screen(photo.corner), width = photo.width * camera.scale;
    const wanted: Record<string, string> = { x: x.toFixed(1), y: y.toFixed(1), width: width.toFixed(1), height: (width * photo.shape).toFixed(1), opacity: String(photo.opacity) };
    if (this.image.getAttribute("href") !== photo.href) this.image.setAttribute("href", photo.href);
    for (const name in wanted) if (this.image.getAttribute(name) !== wanted[name]) this.image.setAttribute(name, wanted[name]);
  }
}
