// Picture of a motor: its phases and its shaft.

const TURN = 200; // full steps per turn

interface Phase {
  name: string;
  /** Relative current, 0 to 1. */
  lit: number;
}

export function Motor({ name, phases, position }: { name: string; phases: Phase[]; position: number }) {
  const angle = (position * 360) / TURN;
  return (
    <svg viewBox="0 0 120 120" class="pg-motor" role="img" aria-label={`${name} at ${position}`}>
      <circle cx="60" cy="60" r="55" class="pg-case" />
      {phases.map((phase, n) => {
        const turn = (n / phases.length) * 2 * Math.PI - Math.PI / 2;
        const [x, y] = [60 + 42 * Math.cos(turn), 60 + 42 * Math.sin(turn)];
        return (
          <g class={phase.lit > 0.5 ? "pg-phase pg-lit" : "pg-phase"}>
            <circle cx={x} cy={y} r="10" />
            <circle cx={x} cy={y} r="10" class="pg-glow" opacity={phase.lit} />
            <text x={x} y={y + 3.5}>
              {phase.name}
            </text>
          </g>
        );
      })}
      <g transform={`rotate(${angle} 60 60)`} class="pg-shaft">
        <circle cx="60" cy="60" r="24" />
        <line x1="60" y1="60" x2="60" y2="38" />
      </g>
    </svg>
  );
}
