// Metrics of several machines beside each other.
import type { Figure } from "./data";
import type { Page } from "./living";
import type { Session } from "./session";
import { quantity } from "./words";

/** What a figure is of, whatever its links are called. */
const sort = (figure: Figure) => `${figure.kind} ${figure.quantity} ${figure.signal.replace(/:.*/, "")}`;

/** Figures of all machines: the same ones by their names, else the only ones of their sort. */
export function rows(sessions: Session[]): (Figure | undefined)[][] {
  const lists = sessions.map(({ data }) => data.numbers), done = new Set<Figure>();
  const twin = (list: Figure[], figure: Figure) => {
    const same = list.find(({ id }) => id === figure.id), alike = list.filter((each) => sort(each) === sort(figure));
    return same ?? (alike.length === 1 && lists.every((all) => all.filter((each) => sort(each) === sort(figure)).length < 2) ? alike[0] : undefined);
  };
  return lists.flat().flatMap((figure) => {
    if (done.has(figure)) return [];
    const row = lists.map((list) => (list.includes(figure) ? figure : twin(list, figure)));
    for (const each of row) if (each) done.add(each);
    return [row];
  });
}

export function Comparison({ page, sessions }: { page: Page; sessions: Session[] }) {
  for (const each of sessions) void each.calm.value;
  const language = page.language.value, numbers = sessions.map((each) => each.model.numbers());
  return (
    <div class="card comparison">
      <h2>{page.say("compare")}</h2>
      <div class="scroll" role="region" tabIndex={0} aria-label={page.say("compare")}>
        <table class="numbers">
          <thead><tr><th scope="col">{page.say("numbers")}</th>{sessions.map((each) => <th scope="col" key={each.number}>{each.data.name[page.language.value]}</th>)}</tr></thead>
          <tbody>
            {rows(sessions).map((row) => {
              const names = [...new Set(row.flatMap((each) => (each ? [each.name[language]] : [])))];
              return (
                <tr key={names.join()}>
                  <th scope="row">{names.join(" / ")}</th>
                  {row.map((each, k) => (
                    <td key={k} title={each ? "" : page.say("unlike", { name: sessions[k].data.name[page.language.value] })}>{each ? quantity(numbers[k][each.id], each.quantity) : "–"}</td>
                  ))}
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </div>
  );
}
