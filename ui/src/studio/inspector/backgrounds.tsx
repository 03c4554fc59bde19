// What lies behind the drawing: a target curve, a photo.
import { Act } from "./fields";
import { Head } from "./head";
import type { PanelProps } from "./selected";

export function CurvePanel({ bench, item }: PanelProps) {
  const { say } = bench;
  return (
    <>
      <Head bench={bench} icon="target" title={say("tool.target")} item={item} fixedName>{say("insp.target_about")}</Head>
      <div class="row-acts"><Act icon="synthesis" act={() => (bench.dock.value = "synthesis")}>{say("insp.to_synthesis")}</Act></div>
    </>
  );
}

export function PhotoPanel({ bench, item }: PanelProps) {
  const { say } = bench;
  return <Head bench={bench} icon="photo" title={say("tool.photo")} item={item} fixedName>{say("insp.photo_about")}</Head>;
}
